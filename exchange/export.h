// A material card, and a specimen if there is one, in the words of another code. What that code's law cannot
// express is said, in the text itself and as a list for whoever asked.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "libdem/material/material_card.h"
#include "specimens/specimen.h"

namespace exchange {

/// csv: plain tables. yade_jcfpm, yade_cpm: Python for Yade, JCFpmMat or CpmMat. lammps_bpm: a LAMMPS input
/// with bond_style bpm/rotational.
enum class Format { csv, yade_jcfpm, yade_cpm, lammps_bpm };

/// The names that --to takes, in the order of Format.
const std::vector<std::string>& format_names();
std::string_view name_of(Format format);
/// The format of that name. Throws InputError, which suggests the nearest.
Format format_named(const std::string& name);

/// What to write.
struct Request {
  const dem::MaterialCard& card;
  const specimens::Specimen* specimen = nullptr;  ///< none: the material alone
  std::string writer = "Spall";                   ///< who writes it, for the first lines
  std::string file_name;  ///< of the text, without its folder: the files beside it are named after it
};

/// A file that the text reads, to lie in the text's folder.
struct Companion {
  std::string name;
  std::string text;
};

struct Exported {
  std::string text;
  std::vector<Companion> beside;  ///< empty without a specimen
  std::vector<std::string> lost;  ///< what the other law does otherwise, one sentence each
};

/// Throws InputError if the card is not valid, or the specimen's links are not those that the format would make
/// anew (a notch was cut).
Exported export_card(Format format, const Request& request);

/// "card.py" and ".spheres" -> "card.spheres": a script's ending is replaced, any other name is lengthened.
std::string companion_name(const std::string& file_name, std::string_view ending);

/// The mass of the concrete over that of its elements' spheres [-]: the density of a sphere is the concrete's
/// times this, so that the specimen weighs what the concrete does.
double density_factor(const specimens::Specimen& specimen);

}  // namespace exchange
