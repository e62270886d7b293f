// What trees over triangles are worth: counted work, build times, and rays aimed at every triangle.
// usage: tree_experiment work|speed|growth|aim [THREADS [MOST_TRIANGLES]]; tables in Markdown
#include "core/tree/tree.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <sys/resource.h>

#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace {

using namespace ptb;

struct Mesh {
    const char* name;
    Triangles triangles;
};

/// With walls around, but the last: the camera is inside.
std::vector<Mesh> meshes() {
    const Triangles walls = room(3);
    return {{"ball", with(walls, flake(0, 190))},    {"flake", with(walls, flake(4, 6))},
            {"hair", with(walls, hair(20000, 8))},   {"menger", with(walls, menger(3))},
            {"slivers", with(walls, slivers(8000))}, {"terrain, open", terrain(300)}};
}

struct Way {
    const char* name;
    TreeSettings settings;
};

std::vector<Way> ways() {
    TreeSettings binned, size, spatial, all;
    binned.method = size.method = TreeMethod::sah;
    binned.size_axis = false;
    binned.reinsertion.passes_most = size.reinsertion.passes_most = spatial.reinsertion.passes_most = 0;
    return {{"binned SAH", binned}, {"+ sizes", size}, {"+ spatial splits", spatial}, {"+ reinsertion", all}};
}

/// Steps a ray.
struct Work {
    double nodes = 0, tests = 0;
};

/// Of diffuse rays: the first bounces of camera rays.
Work diffuse_work(const Tree& tree, const Triangles& triangles) {
    constexpr int rays = 20000;
    Dice dice(7);
    Work work;
    int counted = 0;
    for (int i = 0; i < rays; ++i) {
        const float x = dice.between(-0.5f, 0.5f), y = dice.between(-0.5f, 0.5f);
        const Ray camera{{0.3f, 0.6f, -2.5f}, {x, y - 0.2f, 1}};
        const double u = dice.uniform(), v = dice.uniform();
        const Met first = walk(tree, camera);
        if (first.number == TREE_NOTHING) continue;
        const Met met = walk(tree, bounce(camera, first, triangles[first.number], u, v));
        work.nodes += met.nodes;
        work.tests += met.tests;
        ++counted;
    }
    const double rays_met = std::max(counted, 1);
    return {work.nodes / rays_met, work.tests / rays_met};
}

constexpr TreeLayout layouts[] = {TreeLayout::bvh2, TreeLayout::bvh2q, TreeLayout::wide8};

const char* name_of(TreeLayout layout) {
    switch (layout) {
        case TreeLayout::bvh2:
            return "BVH2";
        case TreeLayout::bvh2q:
            return "BVH2, quantised";
        case TreeLayout::wide8:
            break;
    }
    return "8-wide";
}

double ratio(std::size_t a, std::size_t b) { return static_cast<double>(a) / static_cast<double>(b); }

void work_row(const Mesh& mesh, const Way& way, TreeLayout layout, int threads, double& base,
              double& product) {
    const Tree tree = build_tree(mesh.triangles, layout, way.settings, threads);
    const Work work = diffuse_work(tree, mesh.triangles);
    const double test = layout == TreeLayout::wide8 ? 1 : 0.7;
    const double cost = work.nodes + test * work.tests;
    if (base == 0) base = cost;
    product *= cost / base;
    fmt::print("| {} | {} | {:.3f} | {:.1f} | {} | {:.1f} | {:.1f} | {:.3f} |\n", mesh.name, way.name,
               ratio(tree.facts.references, tree.facts.triangles), tree.facts.sah_cost, tree.facts.stack_most,
               work.nodes, work.tests, cost / base);
}

void print_work(int threads) {
    for (const TreeLayout layout : layouts) {
        const bool wide = layout == TreeLayout::wide8;
        fmt::print("| {} | tree | references | SAH | stack | nodes | {} | work |\n", name_of(layout),
                   wide ? "blocks" : "triangles");
        fmt::print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
        std::vector<double> products(ways().size(), 1);
        for (const Mesh& mesh : meshes()) {
            double base = 0, unused = 1;
            const bool open = mesh.name == std::string("terrain, open");
            for (std::size_t i = 0; i < ways().size(); ++i)
                work_row(mesh, ways()[i], layout, threads, base, open ? unused : products[i]);
        }
        for (std::size_t i = 0; i < products.size(); ++i)
            fmt::print("| geometric mean of the rooms | {} | | | | | | {:.3f} |\n", ways()[i].name,
                       std::pow(products[i], 1 / (static_cast<double>(meshes().size()) - 1)));
        fmt::print("\n");
    }
}

struct Seconds {
    double wall = 0, cpu = 0;
};

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Seconds seconds_of(const auto& what) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    what();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            cpu_seconds() - cpu};
}

void speed_header() {
    fmt::print(
        "| mesh | triangles | layout | s a million | CPU s a million | bytes a triangle | SAH | depth | "
        "nodes a "
        "ray | tests a ray | peak MiB |\n");
    fmt::print("| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
}

/// The peak is of the process so far: triangles and all that was built before, too.
void speed_row(const Mesh& mesh, TreeLayout layout, int threads) {
    Tree tree;
    const Seconds s = seconds_of([&] { tree = build_tree(mesh.triangles, layout, {}, threads); });
    const double millions = 1e-6 * static_cast<double>(mesh.triangles.size());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const Work work = diffuse_work(tree, mesh.triangles);
    fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {} | {:.1f} | {:.1f} | {} |\n",
               mesh.name, mesh.triangles.size(), name_of(layout), s.wall / millions, s.cpu / millions,
               ratio(tree.facts.bytes, tree.facts.triangles), tree.facts.sah_cost, tree.facts.depth,
               work.nodes, work.tests, usage.ru_maxrss / 1024);
}

void print_speed(int threads) {
    speed_header();
    const Triangles walls = room(3);
    for (const Mesh& mesh :
         {Mesh{"flake", with(walls, flake(4, 8))}, Mesh{"hair", with(walls, hair(62500, 8))}})
        for (const TreeLayout layout : layouts) speed_row(mesh, layout, threads);
}

void print_growth(int threads, std::size_t most) {
    speed_header();
    for (const int cells : {8, 25, 79, 250, 790, 2500}) {  // 128 to 12 500 000
        const Mesh mesh{"terrain", terrain(cells)};
        if (mesh.triangles.size() > most) break;
        speed_row(mesh, TreeLayout::bvh2, threads);
    }
    Mesh nested{"one centre", {}},
        equal{"identical", Triangles(1000000, {{{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}}})};
    for (int i = 1; i <= 1000000; ++i) {
        const float s = 1e-6f * static_cast<float>(i);
        nested.triangles.push_back({{{{-s, -s, 0}, {s, -s, 0}, {0, 2 * s, 0}}}});
    }
    for (const Mesh& mesh : {nested, equal}) speed_row(mesh, TreeLayout::bvh2, threads);
}

/// A point on the triangle: where, `kind` says.
Vec3 aim_point(const Triangle& triangle, int kind, Dice& dice) {
    const Vec3 a = to_vec3(triangle.corners[0]), b = to_vec3(triangle.corners[1]),
               c = to_vec3(triangle.corners[2]);
    if (kind == 0) return (a + b + c) * (1.0 / 3);
    const double u = dice.uniform();
    return kind == 1 ? a * (1 - u) + b * u : a;
}

/// Rays from the camera at points of triangles, with the nearest hit at most as far as the point. In double
/// precision a ray may miss an edge by rounding, but then passes between two triangles that share it.
void print_aim(int threads, std::size_t most) {
    fmt::print("| mesh | layout | rays | boxes of what is hit missed |\n| --- | --- | ---: | ---: |\n");
    for (const Mesh& mesh : meshes()) {
        for (const TreeLayout layout : layouts) {
            const Tree tree = build_tree(mesh.triangles, layout, {}, threads);
            Dice dice(11);
            std::size_t rays = 0, lost = 0;
            while (rays < most) {
                const auto i =
                    static_cast<std::size_t>(dice.uniform() * static_cast<double>(mesh.triangles.size()));
                const Triangle& triangle = mesh.triangles[i];
                const Vec3 eye{dice.between(-2.9f, 2.9f), dice.between(-2.9f, 2.9f),
                               dice.between(-2.9f, 2.9f)};
                const Vec3 way = aim_point(triangle, static_cast<int>(rays++ % 3), dice) - eye;
                Ray ray;
                ray.origin = {static_cast<float>(eye.x), static_cast<float>(eye.y),
                              static_cast<float>(eye.z)};
                ray.direction = {static_cast<float>(way.x), static_cast<float>(way.y),
                                 static_cast<float>(way.z)};
                const Met alone = look_everywhere({&triangle, 1}, ray);
                const Met met = walk(tree, ray);
                lost += met.distance > alone.distance ? 1 : 0;
            }
            fmt::print("| {} | {} | {} | {} |\n", mesh.name, name_of(layout), rays, lost);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    const int threads = argc > 2 ? std::atoi(argv[2]) : static_cast<int>(std::thread::hardware_concurrency());
    const std::size_t most = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1000000;
    if (what == "work")
        print_work(threads);
    else if (what == "speed")
        print_speed(threads);
    else if (what == "growth")
        print_growth(threads, most);
    else if (what == "aim")
        print_aim(threads, most);
    else
        fmt::print(stderr, "usage: tree_experiment work|speed|growth|aim [THREADS [MOST]]\n");
}
