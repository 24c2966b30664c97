// Plain tables, for spreadsheets and for codes that have no writer of their own.
#include <fmt/format.h>

#include <iterator>

#include "exchange/link_values.h"
#include "exchange/writers.h"

namespace exchange {

Exported write_csv(const Request& request) {
  Exported out;
  out.text = "key,value,unit,meaning\n";
  for (const dem::CardNumber& number : dem::numbers_of(request.card))
    out.text +=
        fmt::format("{},{},{},\"{}\"\n", number.key, number.value, dem::si_unit(number.kind), number.meaning);
  for (const auto& [key, value] : dem::choices_of(request.card))
    out.text += fmt::format("{},{},-,\n", key, value);
  if (request.specimen == nullptr) return out;

  const specimens::Specimen& specimen = *request.specimen;
  const double density = request.card.density * density_factor(specimen);
  std::string elements = "element,x[m],y[m],z[m],radius[m],density[kg/m3]\n";
  for (std::size_t k = 0; k < specimen.elements(); ++k)
    fmt::format_to(std::back_inserter(elements), "{},{},{},{},{},{}\n", k, specimen.centres[k].x(),
                   specimen.centres[k].y(), specimen.centres[k].z(), specimen.radii[k], density);
  const dem::LinkLaw law = dem::make_link_law(request.card);
  std::string links =
      "a,b,initial_distance[m],area[m2],Kn[N/m],Ks[N/m],tensile_force[N],shear_force[N],rolling_stiffness[N m],"
      "twisting_stiffness[N m]\n";
  for (const specimens::Link& link : specimen.links) {
    const LinkValues v = link_values(law, specimen, link);
    fmt::format_to(std::back_inserter(links), "{},{},{},{},{},{},{},{},{},{}\n", link.a, link.b,
                   link.initial_distance, v.area, v.normal_stiffness, v.shear_stiffness, v.tensile_force,
                   v.shear_force, v.rolling_stiffness, v.twisting_stiffness);
  }
  out.beside.push_back({companion_name(request.file_name, ".elements.csv"), std::move(elements)});
  out.beside.push_back({companion_name(request.file_name, ".links.csv"), std::move(links)});
  return out;
}

}  // namespace exchange
