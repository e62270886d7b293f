#include "core/oracle/facets.h"

#include <algorithm>
#include <cmath>

namespace ptb {
namespace {

constexpr std::size_t group_size = 16;

Facet make_facet(const Mesh& mesh, const Face& face) {
    const Vec3 &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
    return {a, b, c, normalized(cross(b - a, c - a)), mesh.material};
}

Vec3 lowest(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

Vec3 highest(const Vec3& a, const Vec3& b) { return -lowest(-a, -b); }

double largest_coordinate(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// Narrows [begin, end] to where the ray is between two planes; 0 / 0 leaves it as it is.
void clip(double low, double high, double origin, double direction, double& begin, double& end) {
    const double one = (low - origin) / direction, other = (high - origin) / direction;
    begin = std::fmax(begin, std::fmin(one, other));
    end = std::fmin(end, std::fmax(one, other));
}

/// Of a ray: takes it to the z axis by shears, after its longest coordinate was made z.
class Shear {
  public:
    explicit Shear(const PathRay& ray) : origin_(ray.origin) {
        const Vec3& d = ray.direction;
        if (std::abs(d.x) >= std::max(std::abs(d.y), std::abs(d.z)))
            first_ = 1;
        else if (std::abs(d.y) >= std::abs(d.z))
            first_ = 2;
        const Vec3 turned = turn(d);
        x_ = turned.x / turned.z;
        y_ = turned.y / turned.z;
    }
    Vec3 operator()(const Vec3& point) const {
        const Vec3 from_origin = turn(point - origin_);
        return {from_origin.x - x_ * from_origin.z, from_origin.y - y_ * from_origin.z, from_origin.z};
    }

  private:
    Vec3 turn(const Vec3& v) const {
        return first_ == 0 ? v : first_ == 1 ? Vec3{v.y, v.z, v.x} : Vec3{v.z, v.x, v.y};
    }

    Vec3 origin_;
    int first_ = 0;  ///< the coordinate that becomes x
    double x_ = 0, y_ = 0;
};

double side(const Vec3& from, const Vec3& to) { return from.x * to.y - from.y * to.x; }

/// The two faces of an edge see the ray pass it on the same side, so none slips between them: see "Watertight
/// Ray/Triangle Intersection", by Woop, Benthin and Wald.
FacetHit meet(const Facet& facet, const PathRay& ray, const Shear& sheared) {
    const Vec3 a = sheared(facet.a), b = sheared(facet.b), c = sheared(facet.c);
    const double of_a = side(b, c), of_b = side(c, a), of_c = side(a, b);
    const bool passes = std::min({of_a, of_b, of_c}) >= 0 || std::max({of_a, of_b, of_c}) <= 0;
    const double sum = of_a + of_b + of_c;
    if (!passes || sum == 0) return {};
    const Vec3 position = (facet.a * of_a + facet.b * of_b + facet.c * of_c) * (1 / sum);
    const double distance = dot(position - ray.origin, ray.direction);
    if (!(distance > 0)) return {};
    return {distance, 0, position};
}

}  // namespace

Facets::Facets(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        for (const Face& face : mesh.faces) facets_.push_back(make_facet(mesh, face));
    groups_ = (facets_.size() + group_size - 1) / group_size;
    boxes_.resize(2 * groups_);
    const Vec3 all_around = Vec3{1, 1, 1} * margin(scene);
    for (std::size_t group = 0; group < groups_; ++group)
        boxes_[groups_ + group] = box_of_group(group, all_around);
    for (std::size_t i = groups_; i-- > 1;)
        boxes_[i] = {lowest(boxes_[2 * i].low, boxes_[2 * i + 1].low),
                     highest(boxes_[2 * i].high, boxes_[2 * i + 1].high)};
}

/// A million times the rounding of a box's test.
double Facets::margin(const Scene& scene) const {
    double largest = largest_coordinate(scene.camera.position);
    for (const Facet& facet : facets_)
        for (const Vec3& corner : {facet.a, facet.b, facet.c})
            largest = std::max(largest, largest_coordinate(corner));
    return 1e-9 * largest;
}

Facets::Box Facets::box_of_group(std::size_t group, const Vec3& margin) const {
    const std::size_t begin = group * group_size, end = std::min(begin + group_size, facets_.size());
    Box box = {facets_[begin].a, facets_[begin].a};
    for (std::size_t i = begin; i < end; ++i)
        for (const Vec3& corner : {facets_[i].a, facets_[i].b, facets_[i].c})
            box = {lowest(box.low, corner), highest(box.high, corner)};
    return {box.low - margin, box.high + margin};
}

void Facets::meet_group(std::size_t group, const PathRay& ray, int left_out, int other_left_out,
                        FacetHit& best) const {
    const Shear sheared(ray);
    const std::size_t begin = group * group_size, end = std::min(begin + group_size, facets_.size());
    for (std::size_t i = begin; i < end; ++i) {
        const int number = static_cast<int>(i);
        if (number == left_out || number == other_left_out) continue;
        const FacetHit hit = meet(facets_[i], ray, sheared);
        if (hit.distance < best.distance) best = {hit.distance, number, hit.position};
    }
}

FacetHit Facets::nearest(const PathRay& ray, int left_out, int other_left_out) const {
    FacetHit best;
    std::vector<std::size_t> open;
    if (groups_ > 0) open.push_back(1);
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        double begin = 0, end = best.distance;
        clip(boxes_[i].low.x, boxes_[i].high.x, ray.origin.x, ray.direction.x, begin, end);
        clip(boxes_[i].low.y, boxes_[i].high.y, ray.origin.y, ray.direction.y, begin, end);
        clip(boxes_[i].low.z, boxes_[i].high.z, ray.origin.z, ray.direction.z, begin, end);
        if (begin > end) continue;
        if (i >= groups_) {
            meet_group(i - groups_, ray, left_out, other_left_out, best);
        } else {
            open.push_back(2 * i);
            open.push_back(2 * i + 1);
        }
    }
    return best;
}

}  // namespace ptb
