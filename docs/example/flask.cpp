// SPDX-License-Identifier: MIT
// A scene and a claim of one's own with all of Threefold's commands: see README.md beside this file.
//
// The claim is an old trick of perfume makers: in a round flask with a thick wall the hollow looks as many times wider
// as the index of its glass says. A ray that enters at impact parameter b keeps the distance b / n from the centre
// inside the glass (Bouguer's invariant), so that it meets a hollow of radius r just when b < n r. Valid for n r < R:
// in a thinner wall the whole flask looks hollow.
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "scenes/catalogue/common.h"
#include "tools/run.h"
#include "verifier/claims/prediction.h"
#include "verifier/measure/optical_map.h"

using namespace threefold;

namespace {

constexpr double axis_share = 0.1; ///< of R: about the axis a ray lands alike with a hollow and without
constexpr double edge_share = 0.9; ///< of R: beyond it rays leave too steeply to meet the card

/// A flask that stands empty before a card. (Water in it would be glass in glass: the vocabulary has only air in a
/// shell, and says so rather than draw something else.)
SceneRecipe flask() {
    const Specs wall{number_parameter("orb.wall_mm", "thickness of the glass wall", 40, 1e-9, 1e9)};
    return {"flask", "a round flask with a thick wall before a card",
            join({orb_parameters(), wall, glass_parameters(), view_parameters(), card_parameters(),
                  environment_parameters(0.2)}),
            [](const Parameters &p) {
                Scene scene;
                scene.objects = {{"flask", make_shell(p)}, {"card", make_card(p)}};
                scene.environment = make_environment(p);
                scene.camera = make_camera(p);
                return scene;
            }};
}

/// A pixel in which the flask does not show what a solid ball of its glass would show: there the hollow is seen.
bool shows_hollow(const OrbInScene &orb, const Quad &card, const Ray &ray, const std::optional<Vec3> &landed) {
    OrbInScene solid = orb;
    solid.optics = optics::solid_ball(orb.optics.outer_mm, orb.optics.index);
    const std::optional<Vec3> expected = predicted_landing(solid, card, ray);
    return expected && (!landed || glm::length(*landed - *expected) > 0.01 * orb.optics.outer_mm);
}

/// The greatest impact parameter at which the hollow is seen, from the area in which it is.
template <class Landing>
double seen_radius_mm(const OrbInScene &orb, const Quad &card, const Camera &camera, Landing landing) {
    const double R = orb.optics.outer_mm, eye_mm = glm::length(camera.eye_mm - orb.centre_mm);
    const Film film(camera);
    int count = 0;
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column) {
            const Ray ray = film.ray(pixel_sample(camera, column, row));
            const double b = impact_parameter(ray, orb.centre_mm);
            count +=
                b < axis_share * R || (b < edge_share * R && shows_hollow(orb, card, ray, landing(column, row, ray)));
        }
    const double tangent = std::sqrt(count / std::numbers::pi) * film.pixel();
    return eye_mm * std::sin(std::atan(tangent));
}

Claim hollow_looks_wider() {
    Claim claim;
    claim.name = "hollow-looks-wider";
    claim.statement = "The hollow of a thick-walled flask looks as many times wider as the index of its glass.";
    claim.experiments = [](const ClaimContext &context) {
        // The probe: a card that says where each ray landed, seen through glass without reflections (the ideal
        // coating).
        Experiment e =
            context.experiment("hollow", "what is seen through a thick-walled flask", "flask", {},
                               {assign("card.surface", "coordinate"), assign("glass.coating", "antireflective"),
                                assign("glass.interface_transmittance", 1.0), assign("orb.shift_mm", 0.0)});
        e.sampling = Sampling::pixel_centres;
        e.samples_per_pixel = 1;
        e.shift_replicates = true; // each of the eight pictures looks through other points of the pixels
        const OrbInScene orb = orb_of(e.scene);
        const Quad card = card_of(e.scene);
        const double r = orb.optics.inner_mm, wider = orb.optics.index;
        e.surface_tolerance_mm = 1e-4 * r;

        // The tolerance is fixed before anything is rendered: the sum of all that can be off but for noise.
        const double pixel_mm = Film(e.scene.camera).pixel() * glm::length(e.scene.camera.eye_mm - orb.centre_mm);
        e.predict = [=](const Accuracy &a) {
            return std::vector<Expected>{
                {"hollow seen over hollow",
                 "",
                 Relation::equal,
                 wider,
                 {{"pixels", 0.15 * pixel_mm / r, "rays are counted: a seventh of a pixel on a radius"},
                  {"tessellation", 4 * wider * a.surface_mm / r, "both surfaces lie on tessellated spheres"},
                  {"arithmetic", 4 * a.rounding_mm / r, "rounding of positions"}},
                 true},
                {"the hollow looks wider than it is", "", Relation::above, 1, {}}};
        };
        // Where exact optics itself could not be read so (a hollow that fills the flask, a card too small), there is
        // no reading, and the claim is undecided.
        const double exact = seen_radius_mm(orb, card, e.scene.camera, [&](int, int, const Ray &ray) {
            const std::optional<Vec3> landed = predicted_landing(orb, card, ray);
            return landed && on_card(card, *landed) ? landed : std::nullopt;
        });
        const bool readable = std::abs(exact / r - wider) < 0.15 * pixel_mm / r;
        e.measure = [=](const Image &image, const Camera &camera) {
            double ratio = std::numeric_limits<double>::quiet_NaN();
            if (readable)
                ratio = seen_radius_mm(orb, card, camera,
                                       [&](int column, int row, const Ray &) {
                                           return landing_point(card, image.at(column, row));
                                       }) /
                        r;
            return std::vector<Reading>{{"hollow seen over hollow", ratio},
                                        {"the hollow looks wider than it is", ratio}};
        };
        return std::vector{e};
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "A thick wall flatters its content: the hollow looks as many times wider as the index says.";
        case Verdict::fails:
            return "In some renderer the hollow does not look as many times wider as the index says.";
        case Verdict::undecided:
            return "It is not settled how much wider the hollow looks.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const OrbInScene orb = orb_of(context.experiment("", "", "flask", {}, {}).scene);
        const double greatest = optics::critical_radius(orb.optics);
        return std::vector<std::string>{"From an inner radius of " + std::to_string(greatest) +
                                        " mm on the hollow would fill the whole flask (here " +
                                        std::to_string(orb.optics.inner_mm) + " mm)."};
    };
    claim.flips = [](const ClaimContext &) { return std::vector<FlipPoint>{}; };
    claim.mutant = Fault::index_one_percent; // `check --inject RENDERER:index+1%` must make it fail
    return claim;
}

} // namespace

int main(int argc, char **argv) {
    auto scenes = built_in_scenes();
    auto claims = built_in_claims();
    scenes.push_back(flask());
    claims.push_back(hollow_looks_wider());
    return run(argc, argv, scenes, claims);
}
