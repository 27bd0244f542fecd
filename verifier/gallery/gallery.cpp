// SPDX-License-Identifier: MIT
#include "verifier/gallery/gallery.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/process/shell.h"
#include "scenes/validate.h"

namespace threefold {

namespace {

struct PlannedSource {
    std::string scene;
    std::vector<Assignment> assignments;
    Scene built;
};

struct PlannedFigure {
    const Figure *figure;
    const FigureWay *way = nullptr;
    std::vector<PlannedSource> sources; ///< empty: missing
};

std::vector<PlannedFigure> plan_of(const GalleryRequest &request) {
    std::vector<PlannedFigure> plan;
    std::set<std::string> known;
    for (const Figure &figure : request.figures) {
        const FigureWay *way = possible_way(figure, request.scenes);
        plan.push_back({&figure, way, {}});
        if (!way) continue;
        for (const FigureSource &source : way->averaged) {
            const SceneRecipe &recipe = find_scene(request.scenes, source.scene);
            for (const ParameterSpec &s : recipe.parameters) known.insert(s.name);
            PlannedSource planned{
                source.scene,
                assignments_of(*way, source, recipe, request.preset, request.assignments, request.scale),
                {}};
            Parameters values(recipe.parameters, request.preset);
            for (const Assignment &a : planned.assignments) values.set(a.name, a.value);
            planned.built = recipe.make(values);
            validate(planned.built);
            plan.back().sources.push_back(std::move(planned));
        }
    }
    for (const Assignment &a : request.assignments)
        if (!known.contains(a.name))
            throw Error(Exit::usage, unknown_name("parameter", a.name, {known.begin(), known.end()}));
    return plan;
}

std::string file_name(const Figure &figure, const Witness &witness) {
    std::string number = figure.number;
    std::ranges::transform(number, number.begin(), [](unsigned char c) { return std::tolower(c); });
    return fmt::format("figure-{}-{}.png", number, witness.name);
}

std::string render_command(const GalleryRequest &request, const PlannedSource &source, const Witness &witness) {
    std::string command =
        fmt::format("threefold render {} --with {} --preset {} --spp {} --cut {} --seed {}", source.scene, witness.name,
                    to_string(request.preset), request.samples_per_pixel, request.cut_weight, request.seed);
    for (const Assignment &a : source.assignments)
        command += " --set " + shell_quoted(fmt::format("{}={}", a.name, a.value));
    return command;
}

class Run {
public:
    explicit Run(const GalleryRequest &request) : request_(request), plan_(plan_of(request)) {
        for (const PlannedFigure &p : plan_) sources_ += static_cast<double>(p.sources.size());
    }

    Gallery operator()() {
        make_folder(request_.folder); // not before the scenes are known to be good
        Gallery gallery;
        for (const PlannedFigure &planned : plan_) {
            GalleryFigure figure{planned.figure->number, planned.figure->caption, "", "", {}, {}};
            for (const PlannedSource &source : planned.sources) {
                std::string text = source.scene;
                for (const Assignment &a : source.assignments) text += fmt::format(" {}={}", a.name, a.value);
                figure.sources.push_back(text);
            }
            if (planned.way && planned.way != &planned.figure->ways.front())
                figure.instead_of = planned.figure->ways.front().averaged.front().scene;
            if (planned.sources.empty())
                for (const FigureWay &way : planned.figure->ways)
                    for (const FigureSource &source : way.averaged)
                        if (figure.missing.find(source.scene) == std::string::npos)
                            figure.missing += (figure.missing.empty() ? "" : " or ") + source.scene;
            for (const Witness &w : request_.witnesses)
                if (!planned.sources.empty()) figure.pictures.push_back(picture(planned, w));
            gallery.figures.push_back(std::move(figure));
        }
        gallery.exit = exit_;
        return gallery;
    }

private:
    GalleryPicture picture(const PlannedFigure &planned, const Witness &w) {
        GalleryPicture result;
        result.witness = w.name;
        result.title = w.title;
        for (const PlannedSource &source : planned.sources)
            result.commands.push_back(render_command(request_, source, w));
        try {
            if (const auto broken = broken_.find(w.name); broken != broken_.end()) {
                result.problem = broken->second;
                return result;
            }
            std::vector<Image> images;
            for (const PlannedSource &source : planned.sources) {
                const Rendered r = ask(w, source, "figure " + planned.figure->number);
                result.seconds += r.record.seconds;
                images.push_back(r.images.front());
            }
            const Image image = mean(images);
            result.file = file_name(*planned.figure, w);
            result.width_px = image.width;
            result.height_px = image.height;
            result.thumbnail = fitted_within(image, thumbnail_px);
            write_image(request_.folder / result.file, image,
                        {{"threefold:figure", planned.figure->number}, {"threefold:command", result.commands.front()}});
        } catch (const Error &error) {
            // A program that fails, or refuses a scene: the others go on.
            const bool of_renderer =
                w.adapter && (error.code() == Exit::timed_out || error.code() == Exit::input_output ||
                              error.code() == Exit::bad_data);
            if (!of_renderer) throw;
            result.problem = error.what();
            if (error.code() == Exit::timed_out || error.code() == Exit::input_output)
                broken_[w.name] = fmt::format("not tried: figure {} failed", planned.figure->number);
            if (exit_ == Exit::holds) exit_ = error.code();
        }
        return result;
    }

    Rendered ask(const Witness &w, const PlannedSource &source, const std::string &now) {
        const double done = finished_[w.name]++;
        const auto tell = [&](double share) {
            if (request_.on_progress) request_.on_progress(w.name, (done + share) / sources_, now);
        };
        tell(0);
        RenderJob job;
        job.scene = source.built;
        job.samples_per_pixel = request_.samples_per_pixel;
        job.replicates = {{request_.seed, {}}};
        job.cut_weight = request_.cut_weight;
        job.threads = request_.threads;
        Rendered r = render(w, job, {request_.folder, source.scene, request_.tracer, request_.time_limit, tell});
        tell(1);
        return r;
    }

    const GalleryRequest &request_;
    std::vector<PlannedFigure> plan_;
    double sources_ = 0;
    std::map<std::string, double> finished_;
    std::map<std::string, std::string> broken_;
    Exit exit_ = Exit::holds;
};

} // namespace

Gallery make_gallery(const GalleryRequest &request) { return Run(request)(); }

} // namespace threefold
