// SPDX-License-Identifier: MIT
// The pictures on which the power study asks the image judges: textured scenes, by the tracer, honest and faulty.
#pragma once

#include <string>
#include <vector>

#include "verifier/studies/power.h"

namespace threefold {

class PowerPictures {
public:
    explicit PowerPictures(const PowerRequest &request);

    std::vector<std::string> names() const;
    /// Honest pictures of other seeds, and their variance: what a test keeps in its repository.
    void make_references();
    /// One picture a scene, with the fault or (null) without.
    std::vector<PictureJudgement> judge(const InjectedFault *fault, std::uint64_t seed) const;

private:
    struct Place {
        std::string name;
        Scene scene;
        Image mean, variance;
    };

    RenderJob job_of(const Scene &scene, std::vector<std::uint64_t> seeds) const;

    int threads_;
    TracerSettings tracer_;
    std::uint64_t seed_;
    std::vector<Place> places_;
};

} // namespace threefold
