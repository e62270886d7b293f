// Trees over triangles: build times, sizes and counted work. usage: tree_experiment work|growth|speed
// [THREADS]
#include "core/tree/tree.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace {

using namespace ptb;

struct Mesh {
    const char* name;
    Triangles triangles;
};

struct Work {
    double nodes = 0, tests = 0;
    double cost(double test) const { return nodes + test * tests; }
};

double seconds_of(const auto& what) {
    const auto start = std::chrono::steady_clock::now();
    what();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of diffuse rays: camera rays from inside, their first `bounces` bounces not counted but the last.
Work diffuse_work(const Tree& tree, const Triangles& triangles, int rays, int bounces) {
    Dice dice(7);
    Work work;
    int counted = 0;
    for (int i = 0; i < rays; ++i) {
        const float x = dice.between(-0.5f, 0.5f), y = dice.between(-0.5f, 0.5f);
        Ray ray{{0.3f, 0.6f, -2.5f}, {x, y - 0.2f, 1}};
        Met met = walk(tree, ray);
        for (int b = 0; b < bounces && met.number != TREE_NOTHING; ++b) {
            const double u = dice.uniform();
            ray = bounce(ray, met, triangles[met.number], u, dice.uniform());
            met = walk(tree, ray);
            if (b + 1 < bounces) continue;
            work.nodes += met.nodes;
            work.tests += met.tests;
            ++counted;
        }
    }
    return {work.nodes / counted, work.tests / counted};
}

TreeSettings binned() {
    TreeSettings settings;
    settings.method = TreeMethod::sah;
    settings.size_axis = false;
    return settings;
}

std::vector<Mesh> rooms() {
    const Triangles walls = room(3);
    return {{"flake", with(walls, flake(4, 6))},  {"hair", with(walls, hair(20000, 8))},
            {"menger", with(walls, menger(3))},   {"slivers", with(walls, slivers(8000))},
            {"ball", with(walls, flake(0, 190))}, {"terrain", terrain(300)}};
}

void print_work(int threads) {
    fmt::print("| scene | triangles | tree | build ms | references | SAH | depth | nodes | tests | work |\n");
    fmt::print("| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const TreeLayout layout : {TreeLayout::bvh2, TreeLayout::wide8}) {
        double product[3] = {1, 1, 1};
        int scenes = 0;
        const double test = layout == TreeLayout::bvh2 ? 0.7 : 1;
        for (const Mesh& mesh : rooms()) {
            ++scenes;
            double base = 0;
            int kind = 0;
            for (const bool size : {false, true}) {
                for (const TreeMethod method : {TreeMethod::sah, TreeMethod::spatial}) {
                    TreeSettings settings;
                    settings.method = method;
                    settings.size_axis = size;
                    Tree tree;
                    const double s =
                        seconds_of([&] { tree = build_tree(mesh.triangles, layout, settings, threads); });
                    const Work work = diffuse_work(tree, mesh.triangles, 20000, 1);
                    const double cost = work.cost(test);
                    if (base == 0) base = cost;
                    if (kind > 0) product[kind - 1] *= cost / base;
                    ++kind;
                    fmt::print(
                        "| {} | {} | {}{} | {:.0f} | {:.3f} | {:.1f} | {} | {:.1f} | {:.1f} | {:.3f} |\n",
                        mesh.name, mesh.triangles.size(), method == TreeMethod::sah ? "sah" : "spatial",
                        size ? " size" : "", 1000 * s,
                        1.0 * static_cast<double>(tree.facts.references) /
                            static_cast<double>(tree.facts.triangles),
                        tree.facts.sah_cost, tree.facts.depth, work.nodes, work.tests, cost / base);
                }
            }
        }
        for (const double p : product) fmt::print("geometric mean {:.3f}\n", std::pow(p, 1.0 / scenes));
    }
}

void print_speed(int threads) {
    const Triangles walls = room(3);
    const Mesh meshes[] = {{"flake", with(walls, flake(4, 11))}, {"hair", with(walls, hair(62500, 8))}};
    for (const Mesh& mesh : meshes) {
        for (int i = 0; i < 3; ++i) {
            for (const TreeLayout layout : {TreeLayout::bvh2, TreeLayout::wide8}) {
                Tree tree;
                const double s = seconds_of([&] { tree = build_tree(mesh.triangles, layout, {}, threads); });
                fmt::print(
                    "{} {} {}: {:.3f} s a million, {:.1f} bytes a triangle, refs {:.3f} sah {:.2f} depth {} "
                    "stack {}\n",
                    mesh.name, mesh.triangles.size(), layout == TreeLayout::bvh2 ? "bvh2" : "wide8",
                    s * 1e6 / static_cast<double>(mesh.triangles.size()),
                    static_cast<double>(tree.facts.bytes) / static_cast<double>(mesh.triangles.size()),
                    static_cast<double>(tree.facts.references) / static_cast<double>(mesh.triangles.size()),
                    tree.facts.sah_cost, tree.facts.depth, tree.facts.stack_most);
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "work";
    const int threads = argc > 2 ? std::atoi(argv[2]) : static_cast<int>(std::thread::hardware_concurrency());
    if (what == "work") print_work(threads);
    if (what == "speed") print_speed(threads);
}
