// SPDX-License-Identifier: MIT
// The knobs of a renderer that trade time for error, as far as our adapters have them. What a setting does to a picture
// falls apart into noise, which the samples govern, and a systematic error, which the other knobs do.
// Not knobs: the pattern of samples and the exact normals on meshed spheres are fixed in each adapter; POV-Ray's
// emitters are always scaled to the full range of its 16 bits, where quantisation is least.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exporter/job.h"
#include "verifier/tracer/tracer.h"
#include "verifier/witness/witness.h"

namespace threefold {

struct Setting {
    int samples = 16;             ///< a pixel, as RenderJob takes them
    double cut_weight = 1e-6;     ///< end of a ray tree, where a renderer follows one
    double surface_mm = 1e-3;     ///< of meshed glass
    std::optional<int> bounces{}; ///< where a renderer counts them; empty: as deep as it can
    TracerSettings tracer{};

    /// The same but for the samples.
    bool same_system(const Setting &other) const;
};

/// What a setting's picture differs in from the finest of its renderer.
enum class Knob { samples, truncation, tessellation, precision, transport };
std::string_view to_string(Knob knob);

/// "cut 1e-3, 16 samples", only what the renderer has.
std::string describe(const Setting &setting, const Witness &witness, const Scene &scene, bool with_samples = true);
/// The knob as `threefold render` takes it; empty where there is none for it.
std::vector<std::string> render_options(const Setting &setting, const Witness &witness);

/// One setting of a sweep, and what it is there to show.
struct SweepPoint {
    Setting setting;
    Knob knob = Knob::samples;
};

/// The sweep: samples at the renderer's middle setting, and every other knob at one number of samples. The first point
/// is that number at the finest setting, against which the others are held. The finest is as fine as `least_tolerance`,
/// the smallest that is asked of the renderer, requires.
std::vector<SweepPoint> sweep_of(const Witness &witness, const Scene &scene, bool quick, double least_tolerance);

/// Everything but the samples, from cheap to as exact as is sensible: what is tried one after the other.
std::vector<Setting> systems_of(const Witness &witness, const Scene &scene);

/// The next number of samples that the renderer really has: POV-Ray's grids are two pictures of k x k.
int round_up_samples(const Witness &witness, double samples);

RenderJob job_of(const Setting &setting, const Scene &scene, std::vector<std::uint64_t> seeds, int threads);

} // namespace threefold
