#include "tests/support/tree_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace ptb {
namespace {

std::array<float, 3> xyz(const ptb_float4& v) { return {v.x, v.y, v.z}; }

/// Its ways to axis-parallel planes are one multiplication and one subtraction.
struct Slabs {
    std::array<float, 3> inverse, offset;
    std::array<float, 3> on_grid, enter, leave;  ///< of grid coordinates: the inverse, and what is added

    explicit Slabs(const Ray& ray, const TreeGrid& grid) {
        const std::array low = xyz(grid.low), cells = xyz(grid.cells), cell = xyz(grid.cell),
                         room = xyz(grid.room);
        for (std::size_t i = 0; i < 3; ++i) {
            const float d = ray.direction[i];
            inverse[i] = 1 / (std::abs(d) < 1e-18f ? std::copysign(1e-18f, d) : d);
            offset[i] = ray.origin[i] * inverse[i];
            on_grid[i] = inverse[i] * cell[i];
            const float start = ((ray.origin[i] - low[i]) * cells[i] + 0.5f) * on_grid[i];
            enter[i] = -start - room[i] * std::abs(on_grid[i]);
            leave[i] = -start + room[i] * std::abs(on_grid[i]);
        }
    }
    /// Where the ray enters the box, or infinity.
    float entry(const std::array<float, 3>& low, const std::array<float, 3>& high, double most) const {
        return entry_by(most, [&](std::size_t i) {
            return std::minmax({low[i] * inverse[i] - offset[i], high[i] * inverse[i] - offset[i]});
        });
    }
    /// The same of a box by its centre and halves of its edges.
    float entry_around(const std::array<float, 3>& centre, const std::array<float, 3>& half,
                       double most) const {
        return entry_by(most, [&](std::size_t i) {
            const float middle = centre[i] * inverse[i] - offset[i], reach = half[i] * std::abs(inverse[i]);
            return std::pair{middle - reach, middle + reach};
        });
    }

    /// The same of a box by the words of a TreeNode2q.
    float entry_on_grid(const std::array<std::uint32_t, 3>& planes, double most) const {
        return entry_by(most, [&](std::size_t i) {
            const auto plane = [&](bool high) {
                return std::bit_cast<float>(TREE_PLANE | (planes[i] >> (high ? 16 : 0) & 0xffffu) << 8);
            };
            const bool back = on_grid[i] < 0;
            return std::pair{plane(back) * on_grid[i] + enter[i], plane(!back) * on_grid[i] + leave[i]};
        });
    }

  private:
    /// `way` says where the ray enters and leaves the slab of an axis.
    template <class Way>
    static float entry_by(double most, Way way) {
        float near = 0, far = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [enters, leaves] = way(i);
            near = std::max(near, enters);
            far = std::min(far, leaves);
        }
        return near <= far && near <= most ? near : std::numeric_limits<float>::infinity();
    }
};

/// See "Fast, Minimum Storage Ray/Triangle Intersection", by T. Moeller and B. Trumbore.
void meet(const Triangle& triangle, std::uint32_t number, const Ray& ray, Met& met) {
    if (number == ray.left) return;
    const Vec3 a = to_vec3(triangle.corners[0]), d = to_vec3(ray.direction);
    const Vec3 ab = to_vec3(triangle.corners[1]) - a, ac = to_vec3(triangle.corners[2]) - a;
    const Vec3 p = cross(d, ac), t = to_vec3(ray.origin) - a, q = cross(t, ab);
    const double scale = 1 / dot(ab, p), u = dot(t, p) * scale, v = dot(d, q) * scale;
    const double distance = dot(ac, q) * scale;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0)) return;
    if (distance > met.distance || (distance == met.distance && number > met.number)) return;
    met.number = number;
    met.distance = distance;
}

struct Waiting {
    float entry;
    std::uint32_t link;
};

/// A walk through one layout; `open` says what is behind a link.
class Walk {
  public:
    explicit Walk(const Tree& tree, const Ray& ray) : tree_(tree), ray_(ray), slabs_(ray, tree.grid) {}

    Met run() {
        stack_.push_back({0, 0});
        while (!stack_.empty()) {
            const Waiting next = stack_.back();
            stack_.pop_back();
            if (next.entry > met_.distance) continue;
            if (next.link & TREE_LEAF)
                tree_.nodes8.empty() ? test_run(next.link & ~TREE_LEAF) : test_block(next.link & ~TREE_LEAF);
            else
                open_number(next.link);
        }
        return met_;
    }

  private:
    void add(const std::array<float, 3>& low, const std::array<float, 3>& high, std::uint32_t link) {
        add_if(slabs_.entry(low, high, met_.distance), link);
    }
    void add_if(float entry, std::uint32_t link) {
        if (entry < std::numeric_limits<float>::infinity()) stack_.push_back({entry, link});
    }
    void sort_from(std::size_t first) {
        std::sort(stack_.begin() + static_cast<std::ptrdiff_t>(first), stack_.end(),
                  [](const Waiting& a, const Waiting& b) { return a.entry > b.entry; });
    }
    void open_number(std::uint32_t node) {
        if (!tree_.nodes8.empty())
            open(tree_.nodes8[node]);
        else if (!tree_.nodes2q.empty())
            open(tree_.nodes2q[node]);
        else
            open(tree_.nodes2[node]);
    }
    void open(const TreeNode2q& node) {
        ++met_.nodes;
        const std::size_t first = stack_.size();
        add_if(slabs_.entry_on_grid({node.x0, node.y0, node.z0}, met_.distance), node.link0);
        add_if(slabs_.entry_on_grid({node.x1, node.y1, node.z1}, met_.distance), node.link1);
        sort_from(first);
    }
    void open(const TreeNode2& node) {
        ++met_.nodes;
        const std::size_t first = stack_.size();
        add_if(slabs_.entry_around(xyz(node.centre0_link), xyz(node.half0), met_.distance),
               std::bit_cast<std::uint32_t>(node.centre0_link.w));
        add_if(slabs_.entry_around(xyz(node.centre1_link), xyz(node.half1), met_.distance),
               std::bit_cast<std::uint32_t>(node.centre1_link.w));
        sort_from(first);
    }
    void open(const TreeNode8& node) {
        ++met_.nodes;
        const std::size_t first = stack_.size();
        for (std::size_t i = 0; i < 8; ++i)
            add({node.low[0][i], node.low[1][i], node.low[2][i]},
                {node.high[0][i], node.high[1][i], node.high[2][i]}, node.link[i]);
        sort_from(first);
    }
    void test_run(std::uint32_t run) {
        const std::size_t first = run / TREE_LEAF_MOST;
        for (std::size_t i = first; i <= first + run % TREE_LEAF_MOST; ++i) {
            ++met_.tests;
            const TreeTriangle& t = tree_.triangles[i];
            meet({{xyz(t.a_number), xyz(t.b), xyz(t.c)}}, std::bit_cast<std::uint32_t>(t.a_number.w), ray_,
                 met_);
        }
    }
    void test_block(std::uint32_t number) {
        ++met_.tests;
        const TreeBlock8& block = tree_.blocks[number];
        for (std::size_t i = 0; i < 8; ++i) {
            Triangle triangle;
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    triangle.corners[c][axis] = block.corner[c][axis][i];
            meet(triangle, block.number[i], ray_, met_);
        }
    }

    const Tree& tree_;
    const Ray& ray_;
    Slabs slabs_;
    Met met_;
    std::vector<Waiting> stack_;
};

}  // namespace

Vec3 to_vec3(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

Vec3 normal_of(const Triangle& triangle) {
    const Vec3 a = to_vec3(triangle.corners[0]);
    return cross(to_vec3(triangle.corners[1]) - a, to_vec3(triangle.corners[2]) - a);
}

Met walk(const Tree& tree, const Ray& ray) { return Walk(tree, ray).run(); }

Met look_everywhere(std::span<const Triangle> triangles, const Ray& ray) {
    Met met;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) meet(triangles[i], i, ray, met);
    return met;
}

Ray bounce(const Ray& from, const Met& met, const Triangle& triangle, double u, double v) {
    const Vec3 way = to_vec3(from.direction);
    Vec3 normal = normalized(normal_of(triangle));
    if (dot(normal, way) > 0) normal = -normal;
    const double height = 2 * u - 1, radius = std::sqrt(1 - height * height),
                 around = 2 * std::numbers::pi * v;
    const Vec3 direction = normal + Vec3{radius * std::cos(around), radius * std::sin(around), height};
    const Vec3 origin = to_vec3(from.origin) + met.distance * way;
    const auto single = [](const Vec3& a) {
        return std::array{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
    };
    return {single(origin), single(normalized(direction)), met.number};
}

}  // namespace ptb
