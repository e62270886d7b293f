#include <cctype>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/report/formats/formats.h"
#include "bench/report/formats/passed.h"
#include "bench/report/words.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

/// Part of a name: without the spaces that end one and the slashes that part it.
std::string word(std::string text) {
    for (char& c : text)
        if (std::isgraph(static_cast<unsigned char>(c)) == 0 || c == '/') c = '_';
    return text;
}

/// "BenchmarkRender/device=gpu:0/kernel=pt/.../lanes=auto/end": without the last part, a name that ends in a
/// number would be taken for one of so many processors.
std::string name_of(const Case& c) {
    std::string name = "BenchmarkRender/device=" + word(c.device);
    const Case usual = default_case();
    const auto unsaid = [&](const std::string& axis) {
        return is_variant_axis(axis) && case_value(c, axis) == case_value(usual, axis);
    };
    for (const std::string& axis : axis_names())
        if (!unsaid(axis)) name += fmt::format("/{}={}", axis, word(case_value(c, axis)));
    return name + "/end";
}

std::string efficiency_text(const Passed& p, double ns) {
    const auto noise = p.noise();
    return noise ? fmt::format(" {:.6g} efficiency", 1 / (noise->rel_mse * ns * 1e-9)) : "";
}

}  // namespace

std::string go_benchmark(const ResultFile& result) {
    std::string text =
        fmt::format("pkg: ptbench\nhost: {}\ncpu: {}\ntoolversion: {}\n\n", printable(result.host.hostname),
                    printable(result.host.cpu), printable(result.run.tool_version));
    for (const Passed& p : passed(result)) {
        const Statistics& s = *p.record.statistics;
        for (const double ns : p.times_ns)
            text += fmt::format("{} 1 {:.0f} ns/op {:.6g} Msamples/s{}\n", name_of(p.record.params), ns,
                                s.msamples_per_s * s.median_ns / ns, efficiency_text(p, ns));
    }
    return text;
}

}  // namespace ptb
