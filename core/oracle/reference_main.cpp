#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/oracle/oracle.h"
#include "core/oracle/reference.h"
#include "core/scene/scene.h"

namespace {

struct Options {
    std::string scene, kernel = "pt", out = "results/references";
    int size = 128;
    ptb::OracleJob job;
};

void add_options(CLI::App& app, Options& options) {
    app.add_option("--scene", options.scene, "scene file")->required();
    app.add_option("--kernel", options.kernel, "whose twin traces")->check(CLI::IsMember(ptb::tracers()));
    app.add_option("--size", options.size, "pixels a side")->check(CLI::Range(1, 8192));
    app.add_option("--spp", options.job.spp, "samples per pixel")->check(CLI::Range(1, 100'000'000));
    app.add_option("--path-length", options.job.path_length, "most segments of a path")
        ->check(CLI::Range(1, 1'000'000));
    app.add_option("--seed", options.job.seed, "of the random numbers");
    app.add_option("--threads", options.job.threads, "does not change the result")
        ->check(CLI::Range(1, 1024));
    app.add_option("--out", options.out, "folder for NAME.exr and NAME.json");
}

/// The command that repeats the run; the threads are left out since they change nothing.
std::string command(const Options& options) {
    return fmt::format(
        "ptbench_reference --scene {} --kernel {} --size {} --spp {} --path-length {} --seed {}",
        options.scene, options.kernel, options.size, options.job.spp, options.job.path_length,
        options.job.seed);
}

ptb::Reference make_reference(Options& options) {
    const ptb::Scene scene = ptb::load_scene(options.scene);
    options.job.size = {options.size, options.size};
    options.job.on_row = [&](int rows) { fmt::print(stderr, "\r{} of {} rows", rows, options.size); };
    const ptb::OracleResult result = ptb::tracers().at(options.kernel)(scene, options.job);
    fmt::print(stderr, "\n");
    const auto samples = static_cast<double>(result.samples);
    return {.scene = scene.name,
            .kernel = options.kernel,
            .scene_content = scene.content,
            .size = options.job.size,
            .path_length = options.job.path_length,
            .spp = options.job.spp,
            .segments_per_sample = static_cast<double>(result.segments) / samples,
            .segments_variance = result.segments_variance,
            .full_length_share = static_cast<double>(result.full_length_paths) / samples,
            .made_by = command(options),
            .mean = result.mean,
            .variance = result.variance};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Traces a reference on the host, in double precision.");
    Options options;
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        std::filesystem::create_directories(options.out);
        save_reference(options.out, make_reference(options));
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
    return 0;
}
