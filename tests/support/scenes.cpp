#include "tests/support/scenes.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace ptb {

namespace {

Material matte(Vec3 albedo) {
    Material m;
    m.name = "matte";
    m.albedo = albedo;
    return m;
}

Material mirror(Vec3 reflectance) {
    Material m;
    m.name = "mirror";
    m.type = MaterialType::mirror;
    m.reflectance = reflectance;
    return m;
}

Material glass(double ior) {
    Material m;
    m.name = "glass";
    m.type = MaterialType::dielectric;
    m.ior = ior;
    return m;
}

Material light(Vec3 radiance) {
    Material m;
    m.name = "light";
    m.type = MaterialType::emitter;
    m.radiance = radiance;
    m.scatters = false;
    return m;
}

/// An emitter that also scatters, so that paths bounce between dome and balls.
Material dome(Vec3 radiance, Vec3 albedo) {
    Material m = light(radiance);
    m.name = "dome";
    m.albedo = albedo;
    m.scatters = true;
    return m;
}

Camera looking_along_z(double from) { return {{0, 0, from}, {0, 0, 0}, {0, 1, 0}, 50}; }

}  // namespace

Scene shipped_scene(const std::string& name) {
    return load_scene(std::filesystem::path(PTB_SOURCE_DIR) / "configs/scenes" / (name + ".json"));
}

Scene camera_in_glass() {
    Scene scene{"camera_in_glass", looking_along_z(-20), {}, {}};
    scene.materials = {dome({0.2, 0.3, 0.4}, {0.6, 0.5, 0.4}), light({6, 5, 4}), glass(1.5),
                       matte({0.8, 0.4, 0.2})};
    scene.spheres = {{{0, 0, 0}, 60, 0}, {{0, 25, 10}, 8, 1}, {{0, 0, -20}, 3, 2}, {{4, -6, 8}, 7, 3}};
    return scene;
}

Scene nested_glass() {
    Scene scene{"nested_glass", looking_along_z(-30), {}, {}};
    scene.materials = {dome({0.3, 0.3, 0.3}, {0.5, 0.6, 0.7}),
                       glass(1.3),
                       glass(1.6),
                       glass(2.0),
                       light({4, 4, 2}),
                       matte({0.2, 0.7, 0.7})};
    scene.spheres = {{{0, 0, 0}, 80, 0}, {{0, 0, 0}, 10, 1},    {{1, 0, -1}, 7, 2},
                     {{1, 1, -1}, 4, 3}, {{-18, 12, 10}, 6, 4}, {{12, -14, 8}, 6, 5}};
    return scene;
}

Scene glass_balls(int count) {
    Scene scene{"glass_balls", looking_along_z(-40), {}, {}};
    scene.materials = {dome({0.5, 0.6, 0.7}, {0.4, 0.4, 0.4}), glass(1.5), light({5, 3, 2})};
    scene.spheres = {{{0, 0, 0}, 90, 0}, {{0, 30, 0}, 6, 2}};
    for (int i = 0; i < count; ++i)
        scene.spheres.push_back({{i % 8 * 5.0 - 17.5, i / 8 * 5.0 - 10, i % 3 * 6.0}, 2.2, 1});
    return scene;
}

Scene mixed_balls(int count) {
    Scene scene{"mixed_balls", looking_along_z(-45), {}, {}};
    scene.materials = {dome({0.4, 0.5, 0.6}, {0.3, 0.3, 0.3}),
                       matte({0.8, 0.3, 0.3}),
                       matte({0.3, 0.7, 0.4}),
                       mirror({0.9, 0.8, 0.5}),
                       glass(1.4),
                       light({3, 3, 1})};
    scene.spheres = {{{0, 0, 0}, 100, 0}};
    std::mt19937 random(7);
    // A ball stays in its own cell of the grid, so no two overlap. The engine's own numbers: they are the
    // same everywhere.
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    const int edge = static_cast<int>(std::ceil(std::cbrt(count)));
    const double cell = 40.0 / edge;
    for (int i = 0; i + 1 < count; ++i) {
        const double radius = cell * (0.15 + 0.2 * uniform());
        const auto place = [&](int number) {
            return -20 + cell * number + radius + (cell - 2 * radius) * uniform();
        };
        const double x = place(i % edge), y = place(i / edge % edge), z = place(i / edge / edge);
        scene.spheres.push_back({{x, y, z}, radius, 1 + i % 5});
    }
    return scene;
}

Scene random_balls(unsigned seed, bool camera_in_glass) {
    Scene scene{"random_balls", {}, {}, {}};
    scene.materials = {dome({0.3, 0.4, 0.5}, {0.4, 0.3, 0.2}), matte({0.8, 0.4, 0.3}), glass(1.5),
                       mirror({0.8, 0.9, 0.7}), light({4, 3, 2})};
    std::mt19937 random(seed);
    const auto uniform = [&](double least, double most) {
        return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
    };
    scene.camera = {{uniform(-2, 2), uniform(-2, 2), -14}, {0, 0, 0}, {0, 1, 0}, 40};
    scene.spheres = {{{0, 0, 0}, uniform(20, 40), 0}, {scene.camera.position, uniform(1, 2), 2}};
    if (!camera_in_glass) scene.spheres.pop_back();
    for (int i = 0; i < 8; ++i)  // in eight rooms of edge 5
        scene.spheres.push_back(
            {{i % 2 * 5 - uniform(2, 3), i / 2 % 2 * 5 - uniform(2, 3), i / 4 * 5 - uniform(2, 3)},
             uniform(0.5, 2),
             1 + i % 4});
    return scene;
}

Scene moved(const Scene& scene, double scale, const Vec3& by) {
    Scene result = scene;
    for (Vec3* point : {&result.camera.position, &result.camera.look_at}) *point = *point * scale + by;
    for (Sphere& sphere : result.spheres) {
        sphere.centre = sphere.centre * scale + by;
        sphere.radius *= scale;
    }
    for (Mesh& mesh : result.meshes)
        for (Vec3& vertex : mesh.vertices) vertex = vertex * scale + by;
    return result;
}

Scene balls_far_apart(double distance) {
    Scene scene{"balls_far_apart", {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0}, {}, {}};
    scene.camera.fov_deg = 2 * std::atan(4 / distance) * 180 / std::numbers::pi;
    scene.materials = {light({0.5, 0.6, 0.7}), matte({0.8, 0.4, 0.3}), glass(1.5), mirror({0.8, 0.9, 0.7}),
                       light({4, 3, 2})};
    scene.spheres = {{{0, 0, 0}, 20 * distance, 0}, {{0, 2, 1}, 1, 1},
                     {{1, 1, distance}, 1, 1},      {{-1.2, 1, distance}, 1, 2},
                     {{0, -1, distance}, 1, 3},     {{2.5, -1, distance - 1}, 0.5, 4}};
    return scene;
}

Scene balls_at_a_wall(double radius, const std::string& wall) {
    Scene scene{"balls_at_a_wall", {{0, 4, -9}, {0, 0.5, 0}, {0, 1, 0}, 40}, {}, {}};
    scene.materials = {light({0.5, 0.6, 0.7}),
                       matte({0.8, 0.4, 0.3}),
                       glass(1.5),
                       mirror({0.8, 0.9, 0.7}),
                       light({4, 3, 2}),
                       dome({0.2, 0.2, 0.2}, {0.6, 0.6, 0.6}),
                       glass(1.33)};
    const bool is_room = wall == "room", is_water = wall == "water";
    scene.spheres = {{{0, 0, 0}, 10 * radius, 0},
                     {{-2.2, 1, 0}, 1, 1},
                     {{0, 1, 1}, 1, 2},
                     {{2.2, 1, 0}, 1, 3},
                     {{0, 7, 4}, 1, 4}};
    if (is_water)
        for (Sphere& ball : scene.spheres) ball.centre.y -= ball.material == 4 ? 0 : 3;
    scene.spheres.push_back({{0, is_room ? radius : -radius, 0}, radius, is_room ? 5 : is_water ? 6 : 1});
    return scene;
}

Scene mesh_room() {
    return parse_scene(R"({
        "name": "mesh_room",
        "camera": { "position": [0, 0, -2.5], "look_at": [0, -0.2, 0], "up": [0, 1, 0], "fov_deg": 70 },
        "materials": {
            "wall": { "type": "matte", "albedo": [0.7, 0.6, 0.5] },
            "lamp": { "type": "emitter", "radiance": [10, 9, 8] },
            "mirror": { "type": "mirror", "reflectance": [0.9, 0.8, 0.9] },
            "glass": { "type": "dielectric", "ior": 1.5 }
        },
        "spheres": [
            { "centre": [1.2, -1.5, -0.5], "radius": 0.7, "material": "glass" },
            { "centre": [-1.8, -2.2, -0.6], "radius": 0.6, "material": "wall" }
        ],
        "meshes": [
            { "shape": "box", "detail": 1, "material": "wall", "transform": { "scale": 3 } },
            { "shape": "box", "detail": 0, "material": "lamp",
              "transform": { "scale": 0.5, "rotate_deg": [10, 20, 30], "translate": [0, 2, 0] } },
            { "shape": "sphere", "detail": 3, "material": "glass",
              "transform": { "scale": 0.8, "translate": [-1, -1.2, 0.5] } },
            { "shape": "box", "detail": 2, "material": "mirror",
              "transform": { "scale": 0.6, "rotate_deg": [0, 30, 0], "translate": [1.4, 0.2, 1.4] } }
        ]
    })",
                       "mesh_room");
}

Scene lone_triangle() {
    Scene scene{"lone_triangle", looking_along_z(-5), {light({1, 2, 3})}, {}, {}};
    scene.meshes.push_back({"triangle", 0, {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    return scene;
}

Scene needle_room(int strips) {
    Scene scene{"needle_room",
                {{0.3, 0.2, 0.7}, {0.31, -0.4, -1}, {0, 1, 0}, 90},
                {dome({1, 1, 1}, {0.5, 0.6, 0.7})},
                {},
                {}};
    Mesh mesh{"needles", 0, {}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double wall : {-1.0, 1.0})
            for (int i = 0; i <= strips; ++i)
                for (const double end : {-1.0, 1.0}) {
                    const double along = 2.0 * i / strips - 1;
                    const Vec3 turns[] = {{wall, along, end}, {end, wall, along}, {along, end, wall}};
                    mesh.vertices.push_back(turns[axis]);
                    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
                    if (i == 0) continue;
                    mesh.faces.push_back({last - 2, last - 1, last});
                }
    scene.meshes.push_back(mesh);
    return scene;
}

}  // namespace ptb
