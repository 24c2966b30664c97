// From the frames of a run, as ParaView reads them, to the picture in space that its report shows.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "report/scene.h"

namespace app {

/// The scene of the frames in `folder`; none if there are no frames. Of many frames of many elements so many
/// are taken, evenly and with the last, that a report stays of a size to be sent. Throws dem::InputError that
/// names a file that is not what a run leaves.
std::optional<report::Scene> scene_of_frames(const std::filesystem::path& folder, const std::string& title);

}  // namespace app
