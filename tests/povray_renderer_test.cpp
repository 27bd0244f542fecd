// SPDX-License-Identifier: MIT
// The real POV-Ray: cameras, pixels and glass, against small closed forms and a vector form of Snell's law.
#include <cmath>
#include <fstream>
#include <numbers>

#include "scenes/error.h"
#include "tests/povray_fixture.h"

using namespace threefold;
using namespace threefold::povray_tests;

// ---------------------------------------------------------------------------------------------------------------------
// Camera and card

TEST_F(PovRay, sees_the_card_where_the_camera_rays_land_for_any_view_and_offset) {
    Scene oblique = scene_of({card});
    oblique.camera.eye_mm = {310, 170, 700}, oblique.camera.target_mm = {10, -20, -180};
    oblique.camera.up = {0.2, 1, 0.1}, oblique.camera.horizontal_fov_deg = 17;
    oblique.camera.film_offset_px = {0.3, -0.2};
    Scene crop = oblique;
    crop.camera.crop = Crop{5, 17, 40, 20};
    Scene orthographic = crop;
    orthographic.camera.projection = Projection::orthographic, orthographic.camera.orthographic_width_mm = 210;
    for (const Scene &scene : {oblique, crop, orthographic}) {
        RenderJob job = at_pixel_centres(scene);
        job.replicates = {{1, {0.5, 0.25}}};
        const Image image = render(job).front();
        Camera camera = scene.camera;
        camera.film_offset_px += job.replicates.front().film_offset_px;
        expect_card(image, camera, card, {}, step());
    }
}

TEST_F(PovRay, renders_each_replicate_with_its_own_offset) {
    const Scene scene = scene_of({card}, 12, 12);
    RenderJob job = at_pixel_centres(scene);
    job.replicates.clear();
    for (std::uint64_t i = 0; i < 11; ++i) job.replicates.push_back({i, {0.09 * static_cast<double>(i), -0.4}});
    const std::vector<Image> images = render(job);
    ASSERT_EQ(images.size(), 11u);
    for (std::size_t i = 0; i < images.size(); ++i) {
        Camera camera = scene.camera;
        camera.film_offset_px = job.replicates[i].film_offset_px;
        expect_card(images[i], camera, card, {}, step());
    }
}

TEST_F(PovRay, renders_the_same_picture_at_any_scale_and_place) {
    for (const double scale : {1e-6, 1e6})
        for (const double offset : {0.0, 1e6}) {
            Quad quad = card;
            const Vec3 move = Vec3(1, -1, 2) * offset;
            const auto moved = [&](Vec3 p) { return (p + move) * scale; };
            quad.centre_mm = moved(quad.centre_mm), quad.half_u_mm *= scale, quad.half_v_mm *= scale;
            Scene scene = scene_of({GlassBall{.centre_mm = moved(Vec3(0)),
                                              .radius_mm = 68 * scale,
                                              .glass = {.coating = Coating::antireflective}},
                                    quad});
            const Camera standard = scene.camera;
            scene.camera.eye_mm = moved(scene.camera.eye_mm), scene.camera.target_mm = moved(scene.camera.target_mm);
            const Image image = render(at_pixel_centres(scene)).front();
            expect_card(image, standard, card, {{68, 1.51714, 1}}, step(), 0.02);
        }
}

TEST_F(PovRay, averages_a_box_without_bias) {
    // The card's right edge cuts a pixel: the mean over replicates is the covered share.
    Quad quad = card;
    quad.surface = Emissive{};
    Scene scene = scene_of({quad}, 4, 4);
    RenderJob job = at_pixel_centres(scene);
    job.sampling = Sampling::box, job.samples_per_pixel = 3;
    job.replicates.clear();
    for (std::uint64_t i = 0; i < 25; ++i) job.replicates.push_back({i});
    scene.camera.horizontal_fov_deg = job.scene.camera.horizontal_fov_deg = 20;
    const std::vector<Image> images = render(job);
    EXPECT_EQ(exported.supersampling, 2);
    const double half_px = 2 * (150.0 / 1100) / std::tan(10 * std::numbers::pi / 180); // half width of the card
    double mean = 0;
    for (const Image &image : images) mean += image.at(3, 1).r / static_cast<double>(images.size());
    // One of two columns of samples is on the card or not: at most 1/4 standard deviation each.
    EXPECT_NEAR(mean, half_px - 1, 4 * 0.25 / 5);
    EXPECT_GT(mean, 0.4);
    EXPECT_LT(mean, 0.7);
}

// ---------------------------------------------------------------------------------------------------------------------
// Glass

TEST_F(PovRay, bends_light_through_a_ball_as_snell_says) {
    const Scene scene = scene_of({GlassBall{.glass = {.coating = Coating::antireflective}}, card}, 96, 96);
    const Image image = render(at_pixel_centres(scene)).front();
    expect_card(image, scene.camera, card, {{68, 1.51714, 1}}, step());
}

TEST_F(PovRay, bends_light_through_shells_of_any_wall_as_snell_says) {
    for (const double wall : {20.0, 1.36, 0.01, 1e-4}) {
        const Scene scene =
            scene_of({GlassShell{.wall_mm = wall, .glass = {.coating = Coating::antireflective}}, card}, 64, 64);
        const Image image = render(at_pixel_centres(scene)).front();
        expect_card(image, scene.camera, card, {{68, 1.51714, 1}, {68 - wall, 1, 1.51714}}, 2e-5, 1e-3);
    }
}

TEST_F(PovRay, loses_no_light_in_a_white_furnace_but_what_it_is_told_to_drop) {
    Scene scene = scene_of({GlassShell{}}, 24, 24);
    scene.environment = Environment{Rgb(3)};
    double worst = 0;
    const Image image = render(at_pixel_centres(scene)).front();
    for (const Rgb &pixel : image.pixels) worst = std::max(worst, std::abs(1 - pixel.r / 3));
    EXPECT_LT(worst, 5e-3);
}

TEST_F(PovRay, applies_the_interface_transmittance_at_every_crossing_and_to_no_reflection) {
    // In a ball every internal reflection has the same F: F + (1-F)^2 tau^2 (1 + F + F^2 + ...) = F + (1 - F) tau^2.
    const double tau = 0.8, n = 1.51714;
    Scene scene = scene_of({GlassBall{.glass = {n, tau, Coating::fresnel}}}, 32, 32);
    scene.environment = Environment{Rgb(1)};
    const Image image = render(at_pixel_centres(scene)).front();
    double worst = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const double b = impact_mm(ray) / 68;
        const double f = b < 1 ? fresnel(std::sqrt(1 - b * b), n) : 1;
        worst = std::max(worst, std::abs(image.at(column, row).r - (f + (1 - f) * tau * tau)));
    });
    EXPECT_LT(worst, 1.5e-5);
}

TEST_F(PovRay, divides_light_in_a_shell_as_fresnel_says_in_all_orders) {
    // All surfaces are met at two angles only, so the tree folds into three unknowns: what a ray sees in the wall going
    // inwards, in the wall going outwards, and in the hollow.
    const double tau = 0.9, n = 1.51714, inner = 58;
    Scene scene = scene_of({GlassShell{.wall_mm = 68 - inner, .glass = {n, tau, Coating::fresnel}}}, 24, 24);
    scene.environment = Environment{Rgb(1)};
    const Image image = render(at_pixel_centres(scene, 1e-8)).front();
    double worst = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const double b = impact_mm(ray);
        const double f1 = b < 68 ? fresnel(std::sqrt(1 - b * b / 68 / 68), n) : 1;
        const double f2 = b < inner ? fresnel(std::sqrt(1 - b * b / inner / inner), n) : 1;
        double inwards = 0, outwards = 0, hollow = 0;
        for (int i = 0; i < 2000; ++i) {
            outwards = f1 * inwards + (1 - f1) * tau;
            hollow = f2 * hollow + (1 - f2) * tau * outwards;
            inwards = f2 * outwards + (1 - f2) * tau * hollow;
        }
        worst = std::max(worst, std::abs(image.at(column, row).r - (f1 + (1 - f1) * tau * inwards)));
    });
    EXPECT_LT(worst, 3e-5);
}

TEST_F(PovRay, sees_from_inside_the_hollow_the_wall_and_the_ball) {
    struct View {
        Shape orb;
        std::vector<Sphere> spheres;
    };
    const Glass glass{.coating = Coating::antireflective};
    for (const View &view : {View{GlassShell{.wall_mm = 20, .glass = glass}, {{68, 1.51714, 1}, {48, 1, 1.51714}}},
                             View{GlassBall{.glass = glass}, {{68, 1.51714, 1}}}})
        for (const Vec3 eye : {Vec3(20, 5, 11), Vec3(35, 5, -40), Vec3(50, 5, 11)}) {
            Scene scene = scene_of({view.orb, card}, 32, 32);
            scene.camera.eye_mm = eye, scene.camera.target_mm = eye + Vec3(-1, 0, -30);
            scene.camera.horizontal_fov_deg = 30;
            const Image image = render(at_pixel_centres(scene)).front();
            // From the last place all light is kept inside for good, through more reflections than POV-Ray's stack
            // holds.
            const bool trapped = eye.x == 50;
            expect_card(image, scene.camera, card, view.spheres, step(), -1, trapped ? 0 : 0.5);
        }
}

TEST_F(PovRay, reflects_totally_at_the_inner_wall_of_a_coated_shell) {
    const double tau = 0.5, wall = 10;
    Scene scene = scene_of({GlassShell{.wall_mm = wall, .glass = {1.51714, tau, Coating::antireflective}}}, 48, 48);
    scene.environment = Environment{Rgb(1)};
    const Image image = render(at_pixel_centres(scene)).front();
    double worst = 0;
    int rim = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const double b = impact_mm(ray);
        if (b > 58 && b < 68) ++rim;
        const double expected = b > 68 ? 1 : b > 58 ? tau * tau : tau * tau * tau * tau;
        worst = std::max(worst, std::abs(image.at(column, row).r - expected));
        EXPECT_EQ(std::pow(tau, through(ray, {{68, 1.51714, 1}, {58, 1, 1.51714}}).crossings), expected);
    });
    EXPECT_GT(rim, 100);
    EXPECT_LE(worst, step());
}

// ---------------------------------------------------------------------------------------------------------------------
// Names

TEST_F(PovRay, never_runs_what_a_name_says) {
    Scene scene = scene_of({card}, 16, 16);
    scene.name = "\"; #include \"evil.inc\" \n #declare x = 1; /*\r\n#fopen F \"canary\" write\n";
    scene.objects.front().name = "*/ \\\" } \n#include \"evil.inc\"\u2028\u0085 sphere { 0, 1 } \xff\xfe // \x01";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "evil.inc") << "#fopen F \"canary\" write\n#write (F, \"ran\")\n#fclose F\n";
    const Image image = render(at_pixel_centres(scene)).front();
    EXPECT_FALSE(std::filesystem::exists(folder / "canary"));
    expect_card(image, scene.camera, card, {}, step());
}
