// The writers, one file each, and what they share.
#pragma once
#include "exchange/export.h"

namespace exchange {

Exported write_csv(const Request& request);
Exported write_yade_jcfpm(const Request& request);
Exported write_yade_cpm(const Request& request);
Exported write_lammps_bpm(const Request& request);

/// "# - " lines, wrapped at 110 characters: comments of Python and of LAMMPS alike.
std::string comment_list(const std::vector<std::string>& items);

}  // namespace exchange
