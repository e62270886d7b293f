#include <exception>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/micro/benchmarks.h"
#include "bench/version.h"

int main(int argc, char** argv) {
    try {
        benchmark::Initialize(&argc, argv);
        if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
        benchmark::AddCustomContext("ptbench_version", ptb::version::tool);
        benchmark::AddCustomContext("ptbench_git_sha", ptb::version::git_sha);
        ptb::register_host();
        ptb::register_renders();
        benchmark::RunSpecifiedBenchmarks();
        benchmark::Shutdown();
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
}
