// SPDX-License-Identifier: MIT
// The whole composition (figure 1B of the study): a blessing figure before which a hand holds the orb.
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/composition.h"

namespace threefold {

namespace {

Specs crop_parameters() {
    const auto pixels = [](std::string name, std::string description) {
        return ParameterSpec{
            .name = std::move(name), .description = std::move(description), .least = 0, .greatest = 1e6, .whole = true};
    };
    return {pixels("image.crop_x_px", "left edge of the part that is rendered"),
            pixels("image.crop_y_px", "its upper edge"),
            pixels("image.crop_width_px", "its width; 0: the whole picture"),
            pixels("image.crop_height_px", "its height; 0: the whole picture")};
}

std::optional<Crop> make_crop(const Parameters &p) {
    const auto pixels = [&](std::string_view name) { return static_cast<int>(p.number(name)); };
    const Crop crop{pixels("image.crop_x_px"), pixels("image.crop_y_px"), pixels("image.crop_width_px"),
                    pixels("image.crop_height_px")};
    if (crop.width_px == 0 && crop.height_px == 0 && crop.x_px == 0 && crop.y_px == 0) return std::nullopt;
    return crop;
}

} // namespace

SceneRecipe salvator_scene() {
    return {"salvator", "the whole figure: relief, hand and orb, in the study's light",
            join({composition_parameters(), picture_size_parameters(352, 518), crop_parameters()}),
            [](const Parameters &p) {
                Scene scene = composition(p);
                scene.camera = eye_camera(p);
                scene.camera.crop = make_crop(p);
                return scene;
            }};
}

} // namespace threefold
