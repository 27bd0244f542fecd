// SPDX-License-Identifier: MIT
// What this adapter does not say, since it could only say something near it.
#include "exporter/povray/writer.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/light.h"
#include "scenes/texture.h"

namespace threefold::povray {
namespace {

bool is_black(const Rgb &colour) { return colour.r <= 0 && colour.g <= 0 && colour.b <= 0; }

bool is_diffuse(const Surface &surface) {
    return std::visit(overloaded{[](const Diffuse &diffuse) { return !is_black(greatest_value(diffuse.reflectance)); },
                                 [](const Emissive &) { return false; }, [](const CoordinateCard &) { return false; }},
                      surface);
}

} // namespace

void refuse_what_cannot_be_said(const RenderJob &job) {
    const Scene &scene = job.scene;
    if (job.replicates.empty()) refuse("no picture was asked for");
    if (job.slip != Slip{})
        refuse("it cannot be made to follow light wrongly on purpose", "put this fault into another renderer");

    const Object *diffuse = nullptr, *glass = nullptr;
    for (const Object &object : scene.objects) {
        if (const Surface *surface = surface_of(object.shape))
            if (!diffuse && is_diffuse(*surface)) diffuse = &object;
        const std::optional<Sphere> orb = outer_sphere(object.shape);
        if (!orb) continue;
        const Glass &made_of = *glass_of(object.shape);
        glass = &object;
        // POV-Ray looks for total reflection only where it would also follow transmitted light.
        if (made_of.coating == Coating::antireflective && made_of.interface_transmittance <= job.cut_weight &&
            glm::distance(scene.camera.eye_mm, orb->centre_mm) <= orb->radius_mm)
            refuse(fmt::format("total reflection inside {} whose interfaces transmit {} cannot be seen from inside it",
                               in_quotes(object.name), made_of.interface_transmittance));
    }
    if (!diffuse) return;
    if (scene.environment && !is_black(scene.environment->radiance) && scene.environment->dome_directions == 0)
        refuse(fmt::format("the environment's light on the diffuse surface {} would be an integral",
                           in_quotes(diffuse->name)),
               "give the environment a dome of parallel lights, or make the surface emissive");
    if (glass && !lights_on_diffuse(scene).empty() && scene.glass_shadow.rule == GlassShadow::Rule::caustic)
        refuse("light that glass bends onto a diffuse surface cannot be computed to a stated accuracy",
               "use the glass shadow rule none, opaque or constant");
}

} // namespace threefold::povray
