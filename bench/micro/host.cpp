#include <algorithm>
#include <cmath>
#include <random>

#include <benchmark/benchmark.h>

#include "bench/measure/statistics.h"
#include "bench/micro/benchmarks.h"
#include "bench/record/json.h"
#include "bench/record/result_file.h"
#include "bench/validate/validate.h"
#include "core/tree/tree.h"

namespace ptb {

namespace {

constexpr Size film_size = validation_size;
constexpr int film_spp = 64;

/// A reference whose pixels are noise of variance 1 around 10.
Reference noisy_reference() {
    std::mt19937 random(1);
    std::normal_distribution<float> radiance(10, 0.125f);
    Reference reference;
    reference.size = film_size;
    reference.path_length = 5;
    reference.spp = film_spp;
    reference.segments_per_sample = 3;
    reference.segments_variance = 1;
    reference.mean = {film_size, std::vector<float>(3 * film_size.pixels())};
    reference.variance = {film_size, std::vector<float>(3 * film_size.pixels(), 1.0f)};
    for (float& value : reference.mean.rgb) value = radiance(random);
    return reference;
}

void validate_film(benchmark::State& state) {
    const Reference reference = noisy_reference();
    const std::uint64_t samples = film_size.pixels() * film_spp;
    const Film film{reference.mean, reference.variance, samples, 3 * samples, 0, 0};
    const FilmEvidence evidence{film, film_size, film_spp, 5};
    for (auto _ : state) {
        Validation validation = check_film(evidence);
        check_against(validation, evidence, reference);
        if (!validation.valid) state.SkipWithError(validation.reason.c_str());
        benchmark::DoNotOptimize(validation);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(film_size.pixels()));
}

Record a_record(int number) {
    Record record;
    record.params = {"pocl:0", "pt", "thesis", {1024, 1024}, number + 1, 128, {16, 16}, 16};
    record.status = Status::ok;
    record.work.emplace().samples = 1u << 20;
    record.build.emplace().options = "-cl-std=CL1.2 -DPTB_LANES=16";
    for (int i = 0; i < 5; ++i)
        record.samples.push_back({1'000'000 + i, 1'000'000, 1'010'000, 1000, 2000, 0, ""});
    record.statistics.emplace().median_ns = 1e6 / 3;
    record.validation.emplace().checks = {"finite", "counts", "blocks"};
    return record;
}

ResultFile a_result(int records) {
    ResultFile result;
    for (int i = 0; i < records; ++i) result.cases.push_back(a_record(i));
    return result;
}

void write_result_json(benchmark::State& state) {
    const ResultFile result = a_result(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(result_text(result));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void read_result_json(benchmark::State& state) {
    const std::string text = result_text(a_result(static_cast<int>(state.range(0))));
    for (auto _ : state) benchmark::DoNotOptimize(result_from_json(parse_json(text, "memory"), "memory"));
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void describe_a_sample(benchmark::State& state) {
    std::mt19937 random(1);
    std::lognormal_distribution<double> time(10, 0.1);
    std::vector<double> times(static_cast<std::size_t>(state.range(0)));
    for (double& t : times) t = time(random);
    for (auto _ : state) benchmark::DoNotOptimize(describe_times(times));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// Hills over a square: two triangles a cell.
std::vector<Triangle> hills(int cells) {
    const auto at = [](int x, int z) {
        const auto fx = static_cast<float>(x), fz = static_cast<float>(z);
        return std::array{fx, 10 * std::sin(0.1f * fx) * std::cos(0.07f * fz), fz};
    };
    std::vector<Triangle> triangles;
    for (int x = 0; x < cells; ++x) {
        for (int z = 0; z < cells; ++z) {
            triangles.push_back({{at(x, z), at(x, z + 1), at(x + 1, z + 1)}});
            triangles.push_back({{at(x, z), at(x + 1, z + 1), at(x + 1, z)}});
        }
    }
    return triangles;
}

void build_a_tree(benchmark::State& state) {
    const std::vector<Triangle> triangles = hills(100);
    for (auto _ : state)
        benchmark::DoNotOptimize(build_tree(triangles, static_cast<TreeLayout>(state.range(0)), {}, 1));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles.size()));
}

}  // namespace

void register_host() {
    benchmark::RegisterBenchmark("host/validate_film", validate_film)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("host/write_result", write_result_json)
        ->ArgName("records")
        ->Arg(100)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("host/read_result", read_result_json)
        ->ArgName("records")
        ->Arg(100)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("host/statistics", describe_a_sample)
        ->ArgName("times")
        ->Arg(1000)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("host/build_tree", build_a_tree)
        ->ArgName("layout")
        ->Arg(static_cast<int>(TreeLayout::bvh2))
        ->Arg(static_cast<int>(TreeLayout::bvh2q))
        ->Arg(static_cast<int>(TreeLayout::wide8))
        ->Unit(benchmark::kMillisecond);
}

}  // namespace ptb
