// SPDX-License-Identifier: MIT
#include "verifier/studies/extremes.h"

#include <algorithm>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "exporter/process/child.h"
#include "scenes/error.h"
#include "scenes/parameters.h"
#include "verifier/claims/prediction.h"
#include "verifier/studies/extremes_judge.h"

namespace threefold {

namespace {

using Clock = std::chrono::steady_clock;

/// A column of the map: a renderer, or our tracer in one of its precisions.
struct Column {
    const Witness *witness;
    TracerSettings tracer;
    double rounding, floor; ///< as Stated
};

/// Every pixel of one ray each through its centre; trees of glass that splits light are followed far.
RenderJob job_of(const ExtremePoint &point, Probe probe, const Witness &witness, int threads) {
    RenderJob job;
    job.scene = point.scene;
    job.sampling = Sampling::pixel_centres;
    job.threads = threads;
    job.samples_per_pixel = 1;
    if (probe == Probe::light) {
        job.samples_per_pixel = 64; // of a renderer that follows one branch at random
        job.cut_weight = witness.is_tracer() ? 1e-12 : 1e-6;
    }
    return job;
}

/// A number of double precision that a scene could not do without, in words.
std::string reason_of(const Error &error) {
    return error.hint().empty() ? error.what() : fmt::format("{} ({})", error.what(), error.hint());
}

class ExtremesStudy {
public:
    explicit ExtremesStudy(const ExtremesRequest &request) : request_(request), sweeps_(asked_sweeps(request)) {
        for (const Witness &w : request.witnesses) {
            if (!w.is_tracer()) {
                columns_.push_back({&w, {}, 0, 0});
                result_.columns.push_back({w.name, w.title, false});
                continue;
            }
            columns_.push_back({&w, {Precision::double_precision}, 0x1p-53, double_floor});
            result_.columns.push_back({"tracer-double", w.title + ", double", true});
            columns_.push_back({&w, {Precision::single_precision}, 0x1p-24, float_floor});
            result_.columns.push_back({"tracer-float", w.title + ", float", false});
        }
        for (const ExtremeSweep &s : sweeps_) steps_ += static_cast<double>(s.points.size() * columns_.size());
    }

    ExtremesResult operator()() {
        const auto start = Clock::now();
        result_.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
        result_.quick = request_.quick;
        for (const ExtremeSweep &sweep : sweeps_) {
            ExtremeSweepResult r{sweep.name, sweep.title, sweep.number, sweep.probe, {}};
            for (const ExtremePoint &point : sweep.points) r.rows.push_back(row_of(sweep, point));
            result_.sweeps.push_back(std::move(r));
        }
        result_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        return std::move(result_);
    }

private:
    static std::vector<ExtremeSweep> asked_sweeps(const ExtremesRequest &request) {
        std::vector<ExtremeSweep> all = extreme_sweeps(request.quick);
        for (const std::string &name : request.sweeps)
            if (std::ranges::count(extreme_sweep_names(), name) == 0)
                throw Error(Exit::usage, unknown_name("sweep", name, extreme_sweep_names()));
        if (!request.sweeps.empty())
            std::erase_if(all, [&](const ExtremeSweep &s) { return std::ranges::count(request.sweeps, s.name) == 0; });
        return all;
    }

    ExtremeRow row_of(const ExtremeSweep &sweep, const ExtremePoint &point) {
        ExtremeRow row{point.label, point.value, point.promised, 0, {}};
        std::vector<ExactPixel> exact;
        for (const Column &column : columns_) {
            if (request_.on_progress)
                request_.on_progress(done_ / steps_,
                                     fmt::format("{} {}, {}", sweep.name, point.label, column.witness->title));
            row.findings.push_back(finding_of(sweep, point, column, exact, row.condition));
            done_ += 1;
        }
        return row;
    }

    ExtremeFinding finding_of(const ExtremeSweep &sweep, const ExtremePoint &point, const Column &column,
                              std::vector<ExactPixel> &exact, double &condition) {
        RenderJob job = job_of(point, sweep.probe, *column.witness, request_.threads);
        std::optional<Rendered> rendered;
        try {
            rendered = render(*column.witness, job,
                              {request_.folder, fmt::format("{}-{}", sweep.name, point.label), column.tracer,
                               request_.time_limit, nullptr});
        } catch (const Error &error) {
            if (error.code() != Exit::bad_data) throw;
            ExtremeFinding refused;
            refused.standing = Standing::refused;
            refused.reason = reason_of(error);
            return refused;
        }
        const Stated stated{rendered->record.accuracy, column.rounding, column.floor};
        const Image &image = rendered->images.front();
        if (sweep.probe == Probe::light) return judge_light(image, job.scene, stated, job.samples_per_pixel);
        if (exact.empty()) {
            exact = exact_pixels(job.scene);
            const double radius = orb_of(job.scene).optics.outer_mm;
            for (const ExactPixel &e : exact) {
                result_.disagreement = std::max(result_.disagreement, e.disagreement_mm / radius);
                condition = std::max(condition, e.condition_mm / radius);
            }
        }
        return judge_landing(image, job.scene, exact, stated);
    }

    std::vector<ExactPixel> exact_pixels(const Scene &scene) const {
        const int width = scene.camera.image_width_px(), height = scene.camera.image_height_px();
        std::vector<ExactPixel> exact(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        tbb::task_arena arena(request_.threads > 0 ? request_.threads : tbb::task_arena::automatic);
        arena.execute([&] {
            tbb::parallel_for(0, height, [&](int row) {
                if (interrupt_requested) throw Error(Exit::interrupted, "interrupted");
                for (int column = 0; column < width; ++column)
                    exact[static_cast<std::size_t>(row * width + column)] = exact_pixel(scene, column, row);
            });
        });
        return exact;
    }

    const ExtremesRequest &request_;
    std::vector<ExtremeSweep> sweeps_;
    std::vector<Column> columns_;
    ExtremesResult result_;
    double done_ = 0, steps_ = 0;
};

} // namespace

std::string to_string(Standing standing) {
    switch (standing) {
    case Standing::right:
        return "right";
    case Standing::degraded:
        return "degraded";
    case Standing::unresolved:
        return "unresolved";
    case Standing::refused:
        return "refused";
    case Standing::wrong:
        return "wrong";
    }
    return {};
}

std::vector<std::string> ExtremesResult::faults() const {
    std::vector<std::string> all;
    for (const ExtremeSweepResult &sweep : sweeps)
        for (const ExtremeRow &row : sweep.rows)
            for (std::size_t k = 0; k < columns.size(); ++k) {
                const ExtremeFinding &f = row.findings[k];
                const std::string where = fmt::format("{} at {} = {}", columns[k].title, sweep.number, row.label);
                if (f.standing == Standing::wrong)
                    all.push_back(fmt::format("{} ({}): wrong, by {:.1e}, stated {:.1e}{}", where, sweep.name, f.worst,
                                              f.bound, f.reason.empty() ? "" : "; " + f.reason));
                else if (columns[k].is_own && row.promised && f.standing != Standing::right)
                    all.push_back(fmt::format("{} ({}): {}, and right was promised{}", where, sweep.name,
                                              to_string(f.standing), f.reason.empty() ? "" : "; " + f.reason));
            }
    return all;
}

std::vector<std::string> extreme_sweep_names() {
    std::vector<std::string> names;
    for (const ExtremeSweep &s : extreme_sweeps(true)) names.push_back(s.name);
    return names;
}

ExtremesResult study_extremes(const ExtremesRequest &request) { return ExtremesStudy(request)(); }

} // namespace threefold
