// SPDX-License-Identifier: MIT
// The study's figures, once per renderer: pictures, a contact sheet, and an index that says how to repeat each.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "exporter/image/image.h"
#include "scenes/error.h"
#include "verifier/gallery/figures.h"
#include "verifier/witness/witness.h"

namespace threefold {

struct GalleryRequest {
    std::vector<Figure> figures;
    std::vector<Witness> witnesses; ///< present ones
    std::vector<SceneRecipe> scenes;
    std::vector<Assignment> assignments; ///< for every scene that has the parameter
    Preset preset = Preset::text;
    double scale = 0.5; ///< of the study's sizes
    int samples_per_pixel = 9;
    double cut_weight = 1e-3; ///< for the eye: ray trees may be cut early
    std::uint64_t seed = 1;
    int threads = 0;
    TracerSettings tracer;
    std::chrono::milliseconds time_limit{std::chrono::hours(2)};
    std::filesystem::path folder; ///< pictures; `renders/` under it is the cache
    /// `share` of all that this witness has to do.
    std::function<void(const std::string &witness, double share, const std::string &now)> on_progress;
};

struct GalleryPicture {
    std::string witness, title;
    std::string file;                  ///< PNG in the folder; empty: there is none
    std::string problem;               ///< why there is none
    std::vector<std::string> commands; ///< that repeat it; several where it is the mean of several pictures
    double seconds = 0;
    int width_px = 0, height_px = 0;
    Image thumbnail; ///< linear radiance, at most `thumbnail_px` a side
};

struct GalleryFigure {
    std::string number, caption;
    std::string missing;              ///< scenes that the catalogue lacks; empty: it was made
    std::string instead_of;           ///< the scene that the catalogue lacks, where another shows the same
    std::vector<std::string> sources; ///< "salvator orb.kind=solid"; the mean of several
    std::vector<GalleryPicture> pictures;
};

struct Gallery {
    std::vector<GalleryFigure> figures;
    Exit exit = Exit::holds; ///< of the first renderer that failed
};

constexpr int thumbnail_px = 256;
/// How radiance became a picture: said on the page, and done by the writer of PNG files.
inline constexpr const char *tone_curve = "radiance 0 to 1 by the sRGB curve (nearly a gamma of 2.2), the same for all";

/// Renders what the cache does not hold. Throws Error(usage) for an assignment that no scene has, Error(bad_data) for a
/// scene without meaning, both before anything is rendered; what goes wrong in one renderer is told in its picture.
Gallery make_gallery(const GalleryRequest &request);

/// All pictures in rows of figures and columns of renderers, without labels; linear radiance.
Image contact_sheet(const Gallery &gallery);
/// index.html: refers to the pictures beside it and loads nothing else.
std::string to_index(const Gallery &gallery, const GalleryRequest &request, const std::string &command);

/// Mean over areas, so that fine lines keep their weight; never enlarges.
Image fitted_within(const Image &image, int side_px);

} // namespace threefold
