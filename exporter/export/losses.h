// SPDX-License-Identifier: MIT
// What a format cannot say of a scene: a list for people, in the order of weight. An empty one says that nothing is
// lost.
#pragma once

#include <string>
#include <vector>

#include "exporter/export/format.h"
#include "scenes/scene.h"

namespace threefold {

/// One sentence each. Of what this scene has; a format's other limits are not named.
std::vector<std::string> losses(const Scene &scene, ExportFormat format);

/// The text of LOSSES.txt.
std::string losses_text(const std::vector<std::string> &losses, ExportFormat format);

} // namespace threefold
