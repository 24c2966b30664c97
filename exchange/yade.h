// What the two Yade laws share: the head of the script, the file of spheres, the engines that make the links.
#pragma once
#include <string>
#include <vector>

#include "exchange/export.h"

namespace exchange {

/// The part of a script that belongs to one of Yade's laws.
struct YadeLaw {
  std::string title;     ///< "JCFpm (jointed cohesive frictional particle model)"
  std::string material;  ///< Python that appends the material; it may use the names of the card's numbers
  std::string physics;   ///< the Ip2 functor, which makes links in the first step only
  std::string law;       ///< the Law2 functor
  std::string stiffness =
      "";  ///< Python inside the loop over links (`link`): sets their stiffness; "" if Yade's own is right
};

/// The whole script, and the spheres beside it if there is a specimen.
Exported yade_script(const Request& request, const YadeLaw& law, std::vector<std::string> lost);

/// Losses that both laws share: contacts of broken links, and the law with moments.
void add_common_losses(const dem::MaterialCard& card, std::vector<std::string>& lost);

}  // namespace exchange
