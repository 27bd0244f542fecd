// SPDX-License-Identifier: MIT
// The study's figures by the tracer alone, a few pixels wide.
#include "verifier/gallery/gallery.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "scenes/catalogue/catalogue.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

Figure figure(const std::string &number) {
    for (const Figure &f : study_figures())
        if (f.number == number) return f;
    throw std::runtime_error("no figure " + number);
}

/// A figure of a scene that every catalogue has.
Figure plain_figure(std::vector<FigureSource> averaged) { return {"X", "An <orb> & a card.", {{averaged, 64, 32}}}; }

GalleryRequest request(const fs::path &folder, std::vector<Figure> figures) {
    GalleryRequest r;
    r.figures = std::move(figures);
    r.witnesses = find_witnesses({"tracer"});
    r.scenes = built_in_scenes();
    r.scale = 0.25;
    r.samples_per_pixel = 1;
    r.folder = folder;
    return r;
}

TEST(Figures, HaveNumbersOfTheirOwnAndEverythingThatIsSaidOfThem) {
    std::set<std::string> numbers;
    for (const Figure &f : study_figures()) {
        EXPECT_TRUE(numbers.insert(f.number).second) << f.number;
        EXPECT_FALSE(f.caption.empty()) << f.number;
        EXPECT_FALSE(f.ways.empty()) << f.number;
    }
    for (const char *number : {"1B", "2", "3A", "3B", "4A", "4B", "4C", "4D", "5C", "5D", "6A", "6B", "7"})
        EXPECT_TRUE(numbers.contains(number)) << number;
}

TEST(Figures, AreOfScenesAndParametersThatTheCatalogueHas) {
    const std::vector<SceneRecipe> scenes = built_in_scenes();
    for (const Figure &f : study_figures())
        for (const FigureWay &way : f.ways)
            for (const FigureSource &source : way.averaged) {
                const auto recipe = std::ranges::find(scenes, source.scene, &SceneRecipe::name);
                if (recipe == scenes.end()) continue; // reported as missing
                const Figure alone{f.number, f.caption, {{{source}, way.width_px, way.height_px, way.window}}};
                EXPECT_NE(possible_way(alone, scenes), nullptr)
                    << "figure " << f.number << " sets a parameter that " << source.scene << " has not";
            }
}

TEST(Figures, MoveWhatThePresetMoves) {
    const std::vector<SceneRecipe> scenes = built_in_scenes();
    const FigureWay way = figure("6B").ways.front();
    const SceneRecipe &recipe = find_scene(scenes, way.averaged.front().scene);
    const auto robe_from_orb = [&](Preset preset) {
        Parameters values(recipe.parameters, preset);
        for (const Assignment &a : assignments_of(way, way.averaged.front(), recipe, preset, {}, 0.1))
            values.set(a.name, a.value);
        const auto lowest_x = [](const Scene &scene) {
            double x = 1e9;
            for (const Object &object : scene.objects)
                if (object.name == "robe")
                    for (const Vec3 &v : std::get<Mesh>(object.shape).vertices_mm) x = std::min(x, v.x);
            return x;
        };
        Parameters unmoved = values;
        unmoved.set("robe.shift_mm", "0");
        return std::pair{values.number("orb.shift_mm"), lowest_x(recipe.make(values)) - lowest_x(recipe.make(unmoved))};
    };
    EXPECT_EQ(robe_from_orb(Preset::text).first, -10) << "its words move the orb";
    EXPECT_EQ(robe_from_orb(Preset::text).second, 0);
    EXPECT_EQ(robe_from_orb(Preset::published).first, 0);
    EXPECT_NEAR(robe_from_orb(Preset::published).second, 10, 1e-9) << "its files move the relief";
}

TEST(Figures, ScaleTheFilmAndTheWindowTogether) {
    const SceneRecipe recipe{
        "s", "", {{.name = "image.width_px"}, {.name = "image.crop_x_px"}, {.name = "orb.wall_mm"}}, {}};
    const FigureWay way{{{"s", {{"orb.wall_mm", "2.6", "2.72"}}}}, 1408, 2072, Crop{872, 1530, 512, 512}};
    std::string all;
    for (const Assignment &a :
         assignments_of(way, way.averaged[0], recipe, Preset::published, {{"orb.wall_mm", "9"}, {"other", "1"}}, 0.5))
        all += a.name + "=" + a.value + " ";
    EXPECT_EQ(all, "orb.wall_mm=2.72 image.width_px=704 image.crop_x_px=436 ");
}

TEST(Gallery, MakesAPictureAFigureAndARenderer) {
    const tests::TemporaryFolder folder;
    const GalleryRequest r = request(folder.path(), {plain_figure({{"hollow"}}), figure("3A")});
    const Gallery gallery = make_gallery(r);
    EXPECT_EQ(gallery.exit, Exit::holds);
    ASSERT_EQ(gallery.figures.size(), 2u);
    const Image picture = read_image(folder / "figure-x-tracer.png");
    EXPECT_EQ(picture.width, 16);
    EXPECT_EQ(picture.height, 8);
    EXPECT_TRUE(fs::exists(folder / gallery.figures[1].pictures[0].file));
}

TEST(Gallery, AveragesThePicturesOfAFigureThatIsAMean) {
    const tests::TemporaryFolder folder;
    const FigureSource low{"solid", {{"glass.index", "1.486", "1.486"}}},
        high{"solid", {{"glass.index", "1.658", "1.658"}}};
    const auto thumbnail = [&](const Figure &f) {
        return make_gallery(request(folder.path(), {f})).figures[0].pictures[0].thumbnail;
    };
    const Image a = thumbnail(plain_figure({low})), b = thumbnail(plain_figure({high})),
                both = thumbnail(plain_figure({low, high}));
    for (std::size_t i = 0; i < both.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(both.pixels[i][c], (a.pixels[i][c] + b.pixels[i][c]) / 2, 1e-12);
}

TEST(Gallery, ReportsAFigureWhoseSceneIsMissingAndGoesOn) {
    const tests::TemporaryFolder folder;
    const GalleryRequest r = request(folder.path(), {{"9", "A flask.", {{{{"flask"}}}}}, plain_figure({{"hollow"}})});
    const Gallery gallery = make_gallery(r);
    EXPECT_EQ(gallery.exit, Exit::holds);
    EXPECT_EQ(gallery.figures[0].missing, "flask");
    EXPECT_TRUE(gallery.figures[0].pictures.empty());
    EXPECT_EQ(gallery.figures[1].pictures.size(), 1u);
    EXPECT_THAT(to_index(gallery, r, ""), HasSubstr("Needs the scene flask."));
}

TEST(Gallery, TakesFinishedPicturesFromItsCache) {
    const tests::TemporaryFolder folder;
    const GalleryRequest r = request(folder.path(), {plain_figure({{"hollow"}})});
    make_gallery(r);
    const auto renders = [&] {
        return std::distance(fs::directory_iterator(folder / "renders"), fs::directory_iterator{});
    };
    const auto done = *fs::directory_iterator(folder / "renders");
    const auto written = fs::last_write_time(done.path() / "done.json");
    fs::remove(folder / "figure-x-tracer.png");
    make_gallery(r);
    EXPECT_EQ(renders(), 1);
    EXPECT_EQ(fs::last_write_time(done.path() / "done.json"), written);
    EXPECT_TRUE(fs::exists(folder / "figure-x-tracer.png"));
}

TEST(Gallery, RefusesAParameterThatNoSceneHasBeforeItRenders) {
    const tests::TemporaryFolder folder;
    GalleryRequest r = request(folder / "new", {plain_figure({{"hollow"}})});
    r.assignments = {{"orb.wal_mm", "2"}};
    try {
        make_gallery(r);
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::usage);
        EXPECT_THAT(error.what(), HasSubstr("orb.wall_mm"));
    }
    EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST(Gallery, HasAnIndexThatLoadsOnlyThePicturesBesideIt) {
    const tests::TemporaryFolder folder;
    GalleryRequest r = request(folder.path(), {plain_figure({{"hollow"}})});
    Gallery gallery = make_gallery(r);
    gallery.figures[0].pictures[0].title = "</figcaption><script>";
    gallery.figures.push_back({"Y", "<b>", "<i>", "", {}, {}});
    const std::string page = to_index(gallery, r, "threefold gallery '<u>'");
    for (const char *part : {"http:", "https:", "<script", "<b>", "<i>", "<u>", "<link", "@import", "url("})
        EXPECT_THAT(page, Not(HasSubstr(part)));
    for (const char *part : {"src=\"figure-x-tracer.png\"", "An &lt;orb&gt; &amp; a card.", "sRGB curve",
                             "threefold render hollow --with tracer --preset text --spp 1", "--set image.width_px=16",
                             "contact-sheet.png"})
        EXPECT_THAT(page, HasSubstr(part));
}

TEST(ContactSheet, HoldsEveryPictureOnceInItsRowAndColumn) {
    Gallery gallery;
    for (int f = 0; f < 8; ++f) {
        GalleryFigure figure;
        for (int k = 0; k < 2; ++k) {
            GalleryPicture picture;
            picture.thumbnail = Image(4, 3, Rgb(1 + f + 0.1 * k));
            figure.pictures.push_back(picture);
        }
        gallery.figures.push_back(figure);
    }
    gallery.figures.push_back({}); // missing: no row
    const Image sheet = contact_sheet(gallery);
    std::map<double, int> pixels;
    for (const Rgb &pixel : sheet.pixels) ++pixels[pixel.r];
    EXPECT_EQ(pixels.size(), 17u) << "sixteen pictures and the paper";
    for (const auto &[value, n] : pixels) EXPECT_TRUE(value < 1 || n == 12) << value;
    EXPECT_NO_THROW(contact_sheet({}));
}

TEST(ContactSheet, KeepsTheMeanOfAPictureThatItReduces) {
    Image image(301, 97);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(static_cast<double>(i * 7919 % 101));
    const Image small = fitted_within(image, 50);
    EXPECT_EQ(small.width, 50);
    EXPECT_EQ(small.height, 16);
    Rgb before(0), after(0);
    for (const Rgb &p : image.pixels) before += p / static_cast<double>(image.pixels.size());
    for (const Rgb &p : small.pixels) after += p / static_cast<double>(small.pixels.size());
    EXPECT_NEAR(before.r, after.r, 1e-9);
    EXPECT_EQ(fitted_within(image, 1000).width, 301) << "never enlarged";
}

} // namespace
} // namespace threefold
