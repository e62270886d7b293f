#include <cstring>

#include "core/tree/tree.h"

namespace ptb {
namespace {

/// One step of mixing; see "Fast Splittable Pseudorandom Number Generators", by G. Steele, D. Lea and C.
/// Flood.
std::uint64_t mix(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

std::uint64_t hash_of(std::span<const Triangle> triangles) {
    std::uint64_t hash = 0;
    for (const Triangle& triangle : triangles) {
        std::uint64_t words[5] = {};
        std::memcpy(words, &triangle, sizeof triangle);
        for (const std::uint64_t word : words) hash = mix(hash + word + 0x9e3779b97f4a7c15u);
    }
    return hash;
}

}  // namespace

TreeKey tree_key(std::span<const Triangle> triangles, TreeLayout layout, const TreeSettings& settings) {
    return {hash_of(triangles), triangles.size(), layout, settings};
}

}  // namespace ptb
