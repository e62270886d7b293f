#include "core/oracle/facets.h"

#include <algorithm>
#include <cmath>

namespace ptb {
namespace {

Facet make_facet(const Mesh& mesh, const Face& face) {
    const Vec3 &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
    return {a, b, c, normalized(cross(b - a, c - a)), mesh.material};
}

Vec3 lowest(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

Vec3 highest(const Vec3& a, const Vec3& b) { return -lowest(-a, -b); }

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

/// Takes what is nearer than the best one so far, or as near and before it in the scene.
void meet_closer(const Facet& facet, int number, const PathRay& ray, const Shear& sheared, FacetHit& best) {
    const FacetHit hit = meet(facet, ray, sheared);
    if (hit.facet < 0 || hit.distance > best.distance) return;
    if (hit.distance < best.distance || number < best.facet) best = {hit.distance, number, hit.position};
}

/// A thousand times the rounding of a box's test, wherever in the scene a ray begins.
double margin_of(const Scene& scene) {
    double largest = largest_coordinate(scene.camera.position);
    for (const Sphere& sphere : scene.spheres)
        largest = std::max(largest, largest_coordinate(sphere.centre) + sphere.radius);
    for (const Mesh& mesh : scene.meshes)
        for (const Vec3& vertex : mesh.vertices) largest = std::max(largest, largest_coordinate(vertex));
    return 1e-12 * largest;
}

FacetBox box_of(const Facet& facet, const Vec3& margin) {
    return {lowest(lowest(facet.a, facet.b), facet.c) - margin,
            highest(highest(facet.a, facet.b), facet.c) + margin};
}

FacetTree tree_of(const Scene& scene, const std::vector<Facet>& facets) {
    const double margin = margin_of(scene);
    std::vector<FacetBox> boxes;
    boxes.reserve(facets.size());
    for (const Facet& facet : facets) boxes.push_back(box_of(facet, {margin, margin, margin}));
    return FacetTree(boxes);
}

}  // namespace

std::vector<Facet> facets_of(const Scene& scene) {
    std::vector<Facet> facets;
    for (const Mesh& mesh : scene.meshes)
        for (const Face& face : mesh.faces) facets.push_back(make_facet(mesh, face));
    return facets;
}

Facets::Facets(const Scene& scene) : facets_(facets_of(scene)), tree_(tree_of(scene, facets_)) {}

FacetHit Facets::nearest(const PathRay& ray, int left_out, int other_left_out) const {
    const Shear sheared(ray);
    FacetHit best;
    tree_.along(ray, best.distance, [&](std::span<const int> numbers) {
        for (const int number : numbers)
            if (number != left_out && number != other_left_out)
                meet_closer((*this)[number], number, ray, sheared, best);
    });
    return best;
}

FacetHit Facets::nearest_of_each(const PathRay& ray, int left_out, int other_left_out) const {
    const Shear sheared(ray);
    FacetHit best;
    for (int number = 0; number < count(); ++number)
        if (number != left_out && number != other_left_out)
            meet_closer((*this)[number], number, ray, sheared, best);
    return best;
}

}  // namespace ptb
