// SPDX-License-Identifier: MIT
// The set-up seen from aside (figure 2 of the study): no number, the renderers make the same picture.
#include <glm/geometric.hpp>

#include "scenes/camera.h"
#include "scenes/catalogue/composition.h"
#include "verifier/claims/picture_scope.h"
#include "verifier/claims/prediction.h"
#include "verifier/claims/whole_picture.h"

namespace threefold {

namespace {

/// The black ground's left border, by where its ends are seen.
double ground_border_px(const Quad &ground, const Camera &camera, double row_px) {
    const CameraFrame frame = camera_frame(camera);
    const auto seen = [&](double up) {
        const Vec3 d = ground.centre_mm - ground.half_u_mm + up * ground.half_v_mm - camera.eye_mm;
        const double scale = 0.5 * camera.width_px / film_half_width(camera) / glm::dot(d, frame.forward);
        return Vec2(0.5 * camera.width_px + scale * glm::dot(d, frame.right),
                    0.5 * camera.height_px - scale * glm::dot(d, frame.up));
    };
    const Vec2 below = seen(-1), above = seen(1);
    return below.x + (above.x - below.x) * (row_px - below.y) / (above.y - below.y);
}

} // namespace

Claim claim_setup() {
    Claim claim;
    claim.name = "setup";
    claim.statement =
        "The set-up seen from aside, relief, hand, orb and camera, is the same picture in every renderer.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector<Experiment> all{context.quick ? whole_picture(context, "setup", 128, 64, 8)
                                                  : whole_picture(context, "setup", 192, 96, 8)};
        const Quad ground = card_of(all.front().scene);
        all.push_back(
            border_experiment(context, "setup", 256, 128,
                              {"ground", identity_colour("ground"), [ground](const Camera &camera, double row) {
                                   return ground_border_px(ground, camera, row);
                               }}));
        return all;
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "Every renderer paints the same picture of the set-up.";
        case Verdict::fails:
            return "The renderers do not paint the same picture of the set-up.";
        case Verdict::undecided:
            return "It is not settled whether the renderers paint the same picture of the set-up.";
        }
        return "";
    };
    claim.scope = [](const ClaimContext &context, const ScopeSettings &settings) {
        return picture_scope(whole_picture(context, "setup", 192, 96, 1), settings);
    };
    claim.mutant = Fault::camera_one_pixel;
    return claim;
}

} // namespace threefold
