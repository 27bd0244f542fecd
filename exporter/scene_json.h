// SPDX-License-Identifier: MIT
// A scene as JSON: what results say of it, and the text whose hash names it. One way only: nothing reads it back.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "scenes/scene.h"

namespace threefold {

/// Complete and canonical: equal scenes give equal text. Images stand as size and content hash.
nlohmann::ordered_json to_json(const Scene &scene);

std::string scene_hash(const Scene &scene);

} // namespace threefold
