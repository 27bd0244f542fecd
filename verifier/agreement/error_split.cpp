// SPDX-License-Identifier: MIT
#include "verifier/agreement/error_split.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <boost/math/distributions/students_t.hpp>

#include "scenes/error.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

constexpr int tile_px = 8;

/// The mean over pixels and channels of what is estimated pixel by pixel. Neighbours may have a part of their error in
/// common, so the scatter is that of tiles.
Square over_pixels(int width, int height, const std::function<Rgb(std::size_t)> &of_pixel) {
    const auto columns = static_cast<std::size_t>((width + tile_px - 1) / tile_px);
    const auto rows = static_cast<std::size_t>((height + tile_px - 1) / tile_px);
    std::vector<double> sums(columns * rows);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const Rgb e = of_pixel(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(column));
            sums[static_cast<std::size_t>(row / tile_px) * columns + static_cast<std::size_t>(column / tile_px)] +=
                e.r + e.g + e.b;
        }
    const double pixels = 3.0 * width * height, tiles = static_cast<double>(sums.size());
    const double total = std::accumulate(sums.begin(), sums.end(), 0.0), middle = total / tiles;
    double squares = 0;
    for (const double s : sums) squares += (s - middle) * (s - middle);
    return {total / pixels, tiles > 1 ? std::sqrt(squares * tiles / (tiles - 1)) / pixels : std::abs(total / pixels)};
}

/// Sums over a set of runs of the products <d_j, d_k>, means over pixels and channels; d = run - reference. All three
/// squares are functions of these alone.
struct Products {
    double runs = 0, same = 0, all = 0; ///< same: j = k only

    double mse() const { return same / runs; }
    double bias2() const { return (all - same) / (runs * (runs - 1)); }
    double variance() const { return mse() - bias2(); }
};

class RunsOfPictures {
public:
    /// Without a reference: of the pictures themselves.
    RunsOfPictures(std::span<const Image> runs, const Image *reference)
        : count_(runs.size()), products_(count_ * count_) {
        const std::size_t pixels = runs.front().pixels.size();
        std::vector<Rgb> d(count_);
        for (std::size_t i = 0; i < pixels; ++i) {
            for (std::size_t k = 0; k < count_; ++k)
                d[k] = runs[k].pixels[i] - (reference ? reference->pixels[i] : Rgb(0));
            for (std::size_t j = 0; j < count_; ++j)
                for (std::size_t k = 0; k <= j; ++k)
                    products_[j * count_ + k] += d[j].r * d[k].r + d[j].g * d[k].g + d[j].b * d[k].b;
        }
        for (std::size_t j = 0; j < count_; ++j)
            for (std::size_t k = 0; k <= j; ++k)
                products_[k * count_ + j] = products_[j * count_ + k] /= 3 * static_cast<double>(pixels);
    }

    double mse_error() const {
        return jackknife([](const Products &p) { return p.mse(); });
    }

    double variance_error() const {
        // Two runs that share all their noise: one square of a normal number.
        if (count_ == 2) return std::sqrt(2.0) * sums().variance();
        return jackknife([](const Products &p) { return p.variance(); });
    }

    double bias2_error() const {
        if (count_ > 2) return jackknife([](const Products &p) { return p.bias2(); });
        // Of two runs none can be left out. If their pixels share all their noise, the mean difference is a single
        // number, t = M sqrt(2) / s, and M^2 - s^2 / 2 reaches (t^2 - 1) s^2 / 2; a bias adds 2 bias (M - bias).
        const double t = students_factor() * 2;
        return (t * t - 1) * sums().variance() / 4 + students_factor() * std::abs(at(0, 0) - at(1, 1)) / 2;
    }

private:
    double at(std::size_t j, std::size_t k) const { return products_[j * count_ + k]; }

    Products sums() const {
        Products p{static_cast<double>(count_), 0, std::accumulate(products_.begin(), products_.end(), 0.0)};
        for (std::size_t k = 0; k < count_; ++k) p.same += at(k, k);
        return p;
    }

    /// So that two standard errors hold 95 % for so few runs.
    double students_factor() const {
        const boost::math::students_t t(static_cast<double>(count_ - 1));
        return boost::math::quantile(complement(t, 0.025)) / 2;
    }

    /// Efron and Stein, The Jackknife Estimate of Variance, 1981: too large on average, if anything.
    double jackknife(double (*of)(const Products &)) const {
        const Products whole = sums();
        std::vector<double> left;
        for (std::size_t k = 0; k < count_; ++k) {
            double row = 0;
            for (std::size_t j = 0; j < count_; ++j) row += at(k, j);
            left.push_back(of({whole.runs - 1, whole.same - at(k, k), whole.all - 2 * row + at(k, k)}));
        }
        const double middle = std::accumulate(left.begin(), left.end(), 0.0) / whole.runs;
        double squares = 0;
        for (const double l : left) squares += (l - middle) * (l - middle);
        return students_factor() * std::sqrt(squares * (whole.runs - 1) / whole.runs);
    }

    std::size_t count_;
    std::vector<double> products_;
};

Square with_error_of_runs(Square tiles, double of_runs) {
    return {tiles.value, std::hypot(tiles.standard_error, of_runs)};
}

Square scaled(Square s, double mean) { return {s.value / (mean * mean), s.standard_error / (mean * mean)}; }

Image mean_of(std::span<const Image> images) { return mean(std::vector<Image>(images.begin(), images.end())); }

Image spread_of(std::span<const Image> images, const Image &middle) {
    Image spread(middle.width, middle.height);
    for (const Image &image : images)
        for (std::size_t i = 0; i < spread.pixels.size(); ++i) {
            const Rgb d = image.pixels[i] - middle.pixels[i];
            spread.pixels[i] += d * d;
        }
    for (Rgb &pixel : spread.pixels) pixel /= static_cast<double>(images.size() - 1);
    return spread;
}

Image tiles_of(const Image &image) {
    Image tiles((image.width + tile_px - 1) / tile_px, (image.height + tile_px - 1) / tile_px);
    for (int row = 0; row < tiles.height; ++row)
        for (int column = 0; column < tiles.width; ++column) {
            const int right = std::min(image.width, (column + 1) * tile_px);
            const int bottom = std::min(image.height, (row + 1) * tile_px);
            tiles.at(column, row) = rectangle_mean(image, column * tile_px, row * tile_px, right, bottom);
        }
    return tiles;
}

double mean_square(const Image &a, const Image &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const Rgb d = a.pixels[i] - b.pixels[i];
        sum += d.r * d.r + d.g * d.g + d.b * d.b;
    }
    return sum / (3 * static_cast<double>(a.pixels.size()));
}

void require_runs(std::span<const Image> runs, const Image &reference) {
    if (runs.size() < 2) throw Error(Exit::internal, "an error is split by two runs at least");
    for (const Image &image : runs)
        if (image.width != reference.width || image.height != reference.height)
            throw Error(Exit::internal, "pictures of different sizes");
}

} // namespace

ReferencePicture exact_reference(Image picture) {
    ReferencePicture reference;
    reference.variance = Image(picture.width, picture.height);
    reference.mean_radiance = mean_radiance(picture);
    reference.mean = std::move(picture);
    if (!(reference.mean_radiance > 0))
        throw Error(Exit::bad_data, "the picture is black: an error relative to its mean radiance has no meaning");
    return reference;
}

Image variance_of_mean(std::span<const Image> pictures, const Image &middle) {
    require_runs(pictures, middle);
    Image variance = spread_of(pictures, middle);
    for (Rgb &pixel : variance.pixels) pixel /= static_cast<double>(pictures.size());
    return variance;
}

ReferencePicture to_reference(const std::vector<Image> &pictures) {
    ReferencePicture reference = exact_reference(mean(pictures));
    require_runs(pictures, reference.mean);
    reference.variance = variance_of_mean(pictures, reference.mean);
    reference.error = std::sqrt(mean_radiance(reference.variance)) / reference.mean_radiance;
    reference.pictures = static_cast<int>(pictures.size());
    return reference;
}

double Square::root() const { return std::sqrt(std::max(0.0, value)); }

ErrorSplit split_error(std::span<const Image> runs, const ReferencePicture &reference) {
    require_runs(runs, reference.mean);
    const auto count = static_cast<double>(runs.size());
    const Image middle = mean_of(runs), spread = spread_of(runs, middle);
    const Image &r = reference.mean, &v = reference.variance;
    const RunsOfPictures shared(runs, &r);
    const auto over = [&](double of_runs, const std::function<Rgb(std::size_t)> &of_pixel) {
        return scaled(with_error_of_runs(over_pixels(middle.width, middle.height, of_pixel), of_runs),
                      reference.mean_radiance);
    };
    ErrorSplit split;
    split.runs = static_cast<int>(runs.size());
    split.variance = over(shared.variance_error(), [&](std::size_t i) { return spread.pixels[i]; });
    split.bias2 = over(shared.bias2_error(), [&](std::size_t i) {
        const Rgb d = middle.pixels[i] - r.pixels[i];
        return d * d - spread.pixels[i] / count - v.pixels[i];
    });
    split.mse = over(shared.mse_error(), [&](std::size_t i) {
        Rgb sum(0);
        for (const Image &run : runs) {
            const Rgb d = run.pixels[i] - r.pixels[i];
            sum += d * d;
        }
        return sum / count - v.pixels[i];
    });
    const Image reference_tiles = tiles_of(r);
    double tiles = 0;
    for (const Image &run : runs) tiles += mean_square(tiles_of(run), reference_tiles);
    // The noise of the reference in a tile: independent from pixel to pixel.
    const Image noise = tiles_of(v);
    double own = 0;
    for (int row = 0; row < noise.height; ++row)
        for (int column = 0; column < noise.width; ++column) {
            const Rgb n = noise.at(column, row);
            const int wide = std::min(tile_px, middle.width - column * tile_px);
            const int high = std::min(tile_px, middle.height - row * tile_px);
            own += (n.r + n.g + n.b) / (wide * high);
        }
    split.tile_mse = (tiles / count - own / (3 * static_cast<double>(noise.pixels.size()))) /
                     (reference.mean_radiance * reference.mean_radiance);
    return split;
}

Square paired_bias2(std::span<const Image> a, std::span<const Image> b, double mean) {
    if (a.size() != b.size() || a.size() < 2) throw Error(Exit::internal, "pairs of runs, two at least");
    std::vector<Image> differences(a.begin(), a.end());
    for (std::size_t k = 0; k < a.size(); ++k)
        for (std::size_t i = 0; i < a[k].pixels.size(); ++i) differences[k].pixels[i] -= b[k].pixels[i];
    const Image middle = mean_of(differences), spread = spread_of(differences, middle);
    const auto count = static_cast<double>(a.size());
    const Square tiles = over_pixels(middle.width, middle.height, [&](std::size_t i) {
        return middle.pixels[i] * middle.pixels[i] - spread.pixels[i] / count;
    });
    return scaled(with_error_of_runs(tiles, RunsOfPictures(differences, nullptr).bias2_error()), mean);
}

Square error2_of_mean(std::span<const Image> runs, const ReferencePicture &reference) {
    const Image middle = mean_of(runs);
    return scaled(over_pixels(middle.width, middle.height,
                              [&](std::size_t i) {
                                  const Rgb d = middle.pixels[i] - reference.mean.pixels[i];
                                  return d * d - reference.variance.pixels[i];
                              }),
                  reference.mean_radiance);
}

double noise2_of_mean(std::span<const Image> runs, double mean) {
    const Image middle = mean_of(runs);
    return mean_radiance(variance_of_mean(runs, middle)) / (mean * mean);
}

double NoiseLaw::variance(double samples) const { return factor * std::pow(samples, -rate); }

double NoiseLaw::samples(double variance) const {
    if (factor <= 0) return 1;
    if (!(variance > 0)) return std::numeric_limits<double>::infinity();
    return std::max(1.0, std::pow(factor / variance, 1 / rate));
}

NoiseLaw fit_noise_law(std::span<const NoisePoint> points) {
    constexpr double least_rate = 0.5, greatest_rate = 3;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const NoisePoint &p : points) {
        if (!(p.variance > 0)) continue;
        const double lx = std::log(p.samples), ly = std::log(p.variance);
        n += 1, x += lx, y += ly, xx += lx * lx, xy += lx * ly;
    }
    if (n == 0) return {0, 1};
    const double determinant = n * xx - x * x;
    const double slope = determinant > 1e-9 ? (n * xy - x * y) / determinant : -1;
    NoiseLaw law;
    law.rate = std::clamp(-slope, least_rate, greatest_rate);
    law.factor = std::exp((y + law.rate * x) / n);
    return law;
}

std::vector<std::size_t> pareto_front(std::span<const double> costs, std::span<const double> errors) {
    std::vector<std::size_t> order(costs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return costs[a] != costs[b] ? costs[a] < costs[b] : errors[a] < errors[b];
    });
    std::vector<std::size_t> front;
    double best = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order)
        if (errors[i] < best) {
            front.push_back(i);
            best = errors[i];
        }
    return front;
}

} // namespace threefold
