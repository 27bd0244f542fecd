// SPDX-License-Identifier: MIT
#include "exporter/export/display_sphere.h"

#include <fmt/format.h>

#include "exporter/text.h"
#include "scenes/access.h"
#include "scenes/error.h"

namespace threefold {

void refuse_coordinate_card(const Scene &scene, std::string_view title) {
    for (const Object &object : scene.objects)
        if (const Surface *surface = surface_of(object.shape);
            surface && std::holds_alternative<CoordinateCard>(*surface))
            throw Error(
                Exit::bad_data,
                fmt::format("{}: the coordinate card \"{}\" is a probe for renderers, which this format cannot say",
                            title, one_line(object.name)),
                "export a scene whose card has a texture, or the map itself with --to stmap");
}

} // namespace threefold
