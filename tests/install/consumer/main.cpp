// Another project that uses the installed libraries: reads an installed card, converts a unit, writes a page.
#include <cmath>
#include <filesystem>
#include <iostream>

#include "libdem/core/units.h"
#include "libdem/material/material_card.h"
#include "report/page.h"
#include "specimens/specimen.h"

int main() {
  const dem::MaterialCard card =
      dem::read_card(std::filesystem::path(DATA) / "cards" / "paper-slab-table2.toml");
  const double modulus = dem::parse_quantity("30 GPa", dem::Quantity::stress, "consumer");
  specimens::Specimen specimen;
  specimen.size = {0.5, 0.25, 0.25};
  report::Page page;
  page.title = "consumer";
  const bool good = std::abs(card.young_modulus - modulus) < 1 &&
                    std::abs(specimen.volume() - 0.03125) < 1e-12 && report::to_html(page).size() > 1000;
  std::cout << (good ? "the installed libraries work\n" : "the installed libraries give wrong results\n");
  return good ? 0 : 1;
}
