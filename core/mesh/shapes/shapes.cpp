#include "core/mesh/shapes/shapes.h"

namespace ptb {
namespace {

/// Each step of detail cuts every triangle in four.
template <std::uint64_t first>
std::uint64_t fourfold(int detail) {
    return first << (2 * detail);
}

std::uint64_t power(std::uint64_t base, int exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

std::uint64_t menger_triangles(int level) { return 4 * power(20, level) + 8 * power(8, level); }

}  // namespace

int Shape::most_detail(std::uint64_t most_triangles) const {
    int detail = -1;
    while (triangles(detail + 1) <= most_triangles) ++detail;
    return detail;
}

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = {
        {"box", fourfold<12>, make_box},           {"sphere", fourfold<8>, make_sphere},
        {"flake", fourfold<6560>, make_flake},     {"knot", fourfold<1024>, make_knot},
        {"menger", menger_triangles, make_menger}, {"hair", fourfold<1280>, make_hair},
        {"slivers", fourfold<128>, make_slivers},  {"terrain", fourfold<2>, make_terrain}};
    return all;
}

}  // namespace ptb
