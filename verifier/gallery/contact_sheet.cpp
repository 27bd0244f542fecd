// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "verifier/gallery/gallery.h"

namespace threefold {

namespace {

constexpr int gap_px = 6, block_gap_px = 24;
constexpr std::size_t most_rows_in_one_block = 6;
const Rgb paper(0.03);

/// Mean of the part [x0, x1] x [y0, y1] of an image.
Rgb mean_of_area(const Image &image, double x0, double x1, double y0, double y1) {
    Rgb sum(0);
    double area = 0;
    for (int y = static_cast<int>(y0); y < std::min<double>(image.height, std::ceil(y1)); ++y)
        for (int x = static_cast<int>(x0); x < std::min<double>(image.width, std::ceil(x1)); ++x) {
            const double share = (std::min<double>(x + 1, x1) - std::max<double>(x, x0)) *
                                 (std::min<double>(y + 1, y1) - std::max<double>(y, y0));
            sum += share * image.at(x, y);
            area += share;
        }
    return area > 0 ? sum / area : sum;
}

void paste(Image &sheet, const Image &picture, int left, int top) {
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) sheet.at(left + x, top + y) = picture.at(x, y);
}

} // namespace

Image fitted_within(const Image &image, int side_px) {
    const double ratio = std::min(1.0, static_cast<double>(side_px) / std::max(image.width, image.height));
    const int width = std::max(1, static_cast<int>(std::lround(image.width * ratio))),
              height = std::max(1, static_cast<int>(std::lround(image.height * ratio)));
    Image small(width, height);
    const double step_x = static_cast<double>(image.width) / width, step_y = static_cast<double>(image.height) / height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            small.at(x, y) = mean_of_area(image, x * step_x, (x + 1) * step_x, y * step_y, (y + 1) * step_y);
    return small;
}

Image contact_sheet(const Gallery &gallery) {
    struct Row {
        const GalleryFigure *figure;
        int height_px = 1;
    };
    std::vector<Row> rows;
    int columns = 1, cell_px = 1;
    for (const GalleryFigure &figure : gallery.figures) {
        if (figure.pictures.empty()) continue;
        rows.push_back({&figure});
        columns = std::max(columns, static_cast<int>(figure.pictures.size()));
        for (const GalleryPicture &picture : figure.pictures) {
            cell_px = std::max(cell_px, picture.thumbnail.width);
            rows.back().height_px = std::max(rows.back().height_px, picture.thumbnail.height);
        }
    }
    // Two blocks side by side where one would be a ribbon.
    const std::size_t blocks = rows.size() > most_rows_in_one_block ? 2 : 1;
    const std::size_t rows_a_block = (rows.size() + blocks - 1) / blocks;
    const int block_width_px = columns * (cell_px + gap_px) - gap_px;
    int height_px = gap_px, top_px = gap_px;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i == rows_a_block) top_px = gap_px;
        top_px += rows[i].height_px + gap_px;
        height_px = std::max(height_px, top_px);
    }
    Image sheet(2 * gap_px + static_cast<int>(blocks) * (block_width_px + block_gap_px) - block_gap_px, height_px,
                paper);
    top_px = gap_px;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i == rows_a_block) top_px = gap_px;
        int left_px = gap_px + (i < rows_a_block ? 0 : block_width_px + block_gap_px);
        for (const GalleryPicture &picture : rows[i].figure->pictures) {
            const Image &small = picture.thumbnail;
            paste(sheet, small, left_px + (cell_px - small.width) / 2, top_px + (rows[i].height_px - small.height) / 2);
            left_px += cell_px + gap_px;
        }
        top_px += rows[i].height_px + gap_px;
    }
    return sheet;
}

} // namespace threefold
