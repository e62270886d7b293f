#include "core/mesh/geometry.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace ptb {
namespace {

std::uint64_t mixed(std::uint64_t hash, double coordinate) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 29);
}

std::uint64_t hash_of(const Vec3& p) { return mixed(mixed(mixed(0, p.x), p.y), p.z); }

/// Edges of all faces by the direction they are passed in, from the lower vertex to the higher and back; the
/// halves of a word are the lower and the higher number.
struct Edges {
    std::vector<std::uint64_t> upwards, downwards;

    explicit Edges(const std::vector<Face>& faces) {
        for (const Face& face : faces)
            for (std::size_t i = 0; i < 3; ++i) add(face[i], face[(i + 1) % 3]);
        std::sort(upwards.begin(), upwards.end());
        std::sort(downwards.begin(), downwards.end());
    }

  private:
    void add(std::uint64_t from, std::uint64_t to) {
        if (from < to) upwards.push_back(from << 32 | to);
        if (to < from) downwards.push_back(to << 32 | from);
    }
};

std::ptrdiff_t times(std::uint64_t edge, const std::vector<std::uint64_t>& sorted) {
    const auto [begin, end] = std::equal_range(sorted.begin(), sorted.end(), edge);
    return end - begin;
}

}  // namespace

void Geometry::add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::uint32_t first = vertex(a), second = vertex(b), third = vertex(c);
    faces_.push_back({first, second, third});
}

std::uint32_t Geometry::vertex(const Vec3& position) {
    if (2 * vertices_.size() >= slots_.size()) grow();
    const Vec3 unsigned_zeros = position + Vec3{};
    std::uint32_t& slot = slots_[slot_of(unsigned_zeros)];
    if (slot == 0) {
        vertices_.push_back(unsigned_zeros);
        slot = static_cast<std::uint32_t>(vertices_.size());
    }
    return slot - 1;
}

void Geometry::grow() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), 0);
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        slots_[slot_of(vertices_[i])] = static_cast<std::uint32_t>(i + 1);
}

/// Where the vertex of a position is, or would be.
std::size_t Geometry::slot_of(const Vec3& position) const {
    const std::size_t last = slots_.size() - 1;
    std::size_t slot = hash_of(position) & last;
    while (slots_[slot] != 0 && vertices_[slots_[slot] - 1] != position) slot = (slot + 1) & last;
    return slot;
}

std::optional<LooseEdge> loose_edge(const Geometry& geometry) {
    const auto [upwards, downwards] = Edges(geometry.faces());
    const auto [up, down] = std::mismatch(upwards.begin(), upwards.end(), downwards.begin(), downwards.end());
    if (up == upwards.end() && down == downwards.end()) return {};
    const bool is_up = down == downwards.end() || (up != upwards.end() && *up < *down);
    const std::uint64_t edge = is_up ? *up : *down;
    const auto at = [&](std::uint64_t vertex) { return geometry.vertices()[vertex & 0xffffffffu]; };
    return LooseEdge{at(edge >> 32), at(edge), times(edge, upwards), times(edge, downwards)};
}

double signed_volume(const Geometry& geometry) {
    double sixfold = 0;
    for (const Face& face : geometry.faces()) {
        const auto corner = [&](std::size_t i) {
            return geometry.vertices()[face[i]] - geometry.vertices()[0];
        };
        sixfold += dot(corner(0), cross(corner(1), corner(2)));
    }
    return sixfold / 6;
}

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return length(cross(b - a, c - a)) / 2; }

}  // namespace ptb
