// SPDX-License-Identifier: MIT
// A program of the build: writes what stored_figure.cpp takes in. Usage: store_figure FILE
#include <cstdio>
#include <fstream>

#include "scenes/catalogue/painted_robe.h"
#include "scenes/figure/hand_shape.h"
#include "scenes/figure/painted_relief.h"
#include "scenes/figure/relief.h"
#include "scenes/figure/stored_figure.h"

namespace {

template <class T>
void write(std::ofstream &file, const std::vector<T> &list) {
    file.write(reinterpret_cast<const char *>(list.data()), static_cast<std::streamsize>(list.size() * sizeof(T)));
}

} // namespace

int main(int count, char **arguments) {
    using namespace threefold::figure;
    if (count != 2) return 64;
    const threefold::Mesh hand = make_hand_shape();
    const std::vector<double> heights = paint_heights(ReliefGrid(usual_relief_columns));
    const std::vector<std::uint16_t> relief = paint_relief_texture(), robe = threefold::paint_robe_texture();
    const StoredCounts counts{hand.vertices_mm.size(), heights.size(), hand.triangles.size(), relief.size(),
                              robe.size()};
    std::ofstream file(arguments[1], std::ios::binary);
    file.write(reinterpret_cast<const char *>(&counts), sizeof counts);
    write(file, hand.vertices_mm);
    write(file, heights);
    write(file, hand.triangles);
    write(file, relief);
    write(file, robe);
    file.close();
    if (file) return 0;
    std::fprintf(stderr, "cannot write %s\n", arguments[1]);
    return 74;
}
