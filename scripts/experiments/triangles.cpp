// triangles_experiment DEVICE SCENE... -- KERNEL_DIR...: speed of `pt` in scenes of triangles, and the ratios
// of other kernels' to that of the first folder, by turns, in the device's own time; of the first also with
// both layouts of the tree. Prints a table (Markdown).
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/integrator/registry.h"
#include "core/source/source.h"

namespace {

using namespace ptb;

constexpr int rounds = 5;  ///< of each, by turns

/// What is timed: a folder of kernels, and the tree's layout.
struct Runner {
    std::string name, kernel_dir;
    Bvh bvh = Bvh::automatic;
};

RenderJob job_of(const Runner& runner) {
    RenderJob job;
    job.size = {1024, 1024};
    job.spp = 32;
    job.path_length = 10;
    job.variant.bvh = runner.bvh;
    return job;
}

std::unique_ptr<Render> make_render(const ocl::Device& device, const Scene& scene, const Runner& runner) {
    const Integrator& pt = integrator("pt");
    const RenderJob job = job_of(runner);
    const ocl::Program program =
        ocl::build(device, kernel_source(pt.file(), runner.kernel_dir), pt.options(device, scene, job));
    return pt.make(device, program, scene, job);
}

/// Segments a nanosecond of the device's time.
double speed_of(Render& render) {
    render.restart();
    std::uint64_t ns = 0;
    while (render.samples_left() > 0)
        for (const LaunchTimes& times : render.advance(std::uint64_t{1} << 22)) ns += times.end - times.start;
    return static_cast<double>(render.read_film().segments) / static_cast<double>(ns);
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

void print_row(const ocl::Device& device, const std::string& file, const std::vector<Runner>& runners) {
    const Scene scene = load_scene(file);
    std::vector<std::unique_ptr<Render>> renders;
    for (const Runner& runner : runners) renders.push_back(make_render(device, scene, runner));
    for (const auto& render : renders) speed_of(*render);
    std::vector<std::vector<double>> speeds(runners.size()), ratios(runners.size());
    for (int i = 0; i < rounds; ++i)
        for (std::size_t k = 0; k < renders.size(); ++k) {
            speeds[k].push_back(speed_of(*renders[k]));
            ratios[k].push_back(speeds[k].back() / speeds[0].back());
        }
    fmt::print("| {} | {} | {:.3f}", scene.name, triangle_count(scene), median(speeds[0]));
    for (std::size_t k = 1; k < runners.size(); ++k) fmt::print(" | {:.3f}", median(ratios[k]));
    fmt::print(" |\n");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const auto end = std::find(words.begin(), words.end(), "--");
    if (words.size() < 2 || words.end() - end < 2) {
        fmt::print(stderr, "usage: triangles_experiment DEVICE SCENE... -- KERNEL_DIR...\n");
        return 2;
    }
    std::vector<Runner> runners;
    for (auto dir = end + 1; dir != words.end(); ++dir) runners.push_back({*dir, *dir});
    for (const auto& [name, bvh] :
         {std::pair("bvh2", Bvh::bvh2), std::pair("bvh2q", Bvh::bvh2q), std::pair("wide8", Bvh::wide8)})
        runners.push_back({name, runners[0].kernel_dir, bvh});
    const ocl::Device device = ocl::open_device(words[0]);
    fmt::print("{}, pt, 10 segments\n\n| scene | triangles | Gsegments/s", device.info.name);
    for (std::size_t k = 1; k < runners.size(); ++k) fmt::print(" | {}", runners[k].name);
    fmt::print(" |\n| --- |");
    for (std::size_t k = 0; k <= runners.size(); ++k) fmt::print(" ---: |");
    fmt::print("\n");
    for (auto scene = words.begin() + 1; scene != end; ++scene) print_row(device, *scene, runners);
}
