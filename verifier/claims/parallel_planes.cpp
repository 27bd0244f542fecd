// SPDX-License-Identifier: MIT
#include "verifier/claims/parallel_planes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace threefold {

namespace {

struct Strip {
    double height_mm, width_mm;
};

std::vector<Strip> strips(double from, double to, double width) {
    const int count = std::max(1, static_cast<int>(std::ceil((to - from) / width)));
    std::vector<Strip> all;
    for (int k = 0; k < count; ++k) all.push_back({from + (to - from) * (k + 0.5) / count, (to - from) / count});
    return all;
}

/// Exact for the whole strip: the integral of the kernel.
double factor(double gap, double height, const Strip &strip) {
    const auto edge = [&](double y) { return (y - height) / std::hypot(gap, y - height); };
    return (edge(strip.height_mm + strip.width_mm / 2) - edge(strip.height_mm - strip.width_mm / 2)) / 2;
}

double received(double gap, double height, const std::vector<Strip> &from, const std::vector<double> &radiosity) {
    double sum = 0;
    for (std::size_t k = 0; k < from.size(); ++k) sum += radiosity[k] * factor(gap, height, from[k]);
    return sum;
}

} // namespace

std::function<double(double)> thrown_back(const TwoPlanes &p, const std::function<double(double)> &direct) {
    const double width = p.gap_mm / 10; // the kernel is some gaps wide
    constexpr double least_share = 1e-6;
    const std::vector<Strip> wall = strips(p.wall_from_mm, p.wall_to_mm, width), board = strips(0, p.board_mm, width);
    std::vector<double> first, from_wall, from_board(board.size(), 0.0);
    for (const Strip &s : wall) first.push_back(direct(s.height_mm));
    double share = 1;
    do {
        from_wall.clear();
        for (std::size_t k = 0; k < wall.size(); ++k)
            from_wall.push_back(p.wall_reflectance *
                                (first[k] + received(p.gap_mm, wall[k].height_mm, board, from_board)));
        for (std::size_t k = 0; k < board.size(); ++k)
            from_board[k] = p.board_reflectance * received(p.gap_mm, board[k].height_mm, wall, from_wall);
        share *= p.wall_reflectance * p.board_reflectance;
    } while (share > least_share);
    return [=](double height) { return received(p.gap_mm, height, board, from_board); };
}

} // namespace threefold
