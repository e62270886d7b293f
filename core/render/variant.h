#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

namespace ptb {

enum class SceneMemory { automatic, argument, constant, global, local, private_memory };
enum class FilmMemory { buffer, image };
enum class QueueOrder { in_order, out_of_order };
enum class Dispatch { ndrange, tasks };
enum class PixelFilter { jitter, centre, stratified };
enum class Rng { automatic, hash, park_miller };
enum class Roulette { off, albedo };
enum class BuildMode { standard, strict, relaxed };
enum class Bvh { automatic, bvh2, bvh2q, wide8 };
enum class BvhSplit { spatial, sah, spatial_xyz, sah_xyz };
enum class Reconstruction { weighted, l2, l1, none };
enum class RayKind { primary, bounce1, bounce3, shadow };

/// How an integrator's work is expressed in OpenCL, beyond lanes and work-groups: the choices that the 2016
/// thesis discusses. Which of them an integrator has, it says itself (`Integrator::refusal`).
struct Variant {
    SceneMemory scene_memory = SceneMemory::automatic;  ///< memory that rays read the spheres from
    FilmMemory film_memory = FilmMemory::buffer;        ///< what holds the pixels' sums
    QueueOrder queue =
        QueueOrder::in_order;  ///< out of order: a pass is several launches that do not wait for each other
    Dispatch dispatch = Dispatch::ndrange;           ///< tasks: many launches of one work-item
    PixelFilter pixel_filter = PixelFilter::jitter;  ///< where in its pixel a sample lies
    Rng rng = Rng::automatic;
    Roulette roulette = Roulette::off;  ///< albedo: paths go on with what a surface reflects as chance
    BuildMode build = BuildMode::standard;
    Bvh bvh = Bvh::automatic;                ///< how the tree of a scene's meshes lies in memory
    BvhSplit bvh_split = BvhSplit::spatial;  ///< how it is built; xyz: boxes are not parted by size
    RayKind ray_kind = RayKind::primary;     ///< of a list of rays
    Reconstruction reconstruction = Reconstruction::weighted;  ///< of a picture from its gradients
    auto operator<=>(const Variant&) const = default;
};

/// One member of Variant as an axis of a sweep.
struct VariantAxis {
    std::string name, help;
    std::vector<std::string> values;  ///< the first is the default
    std::size_t (*get)(const Variant&);
    void (*set)(Variant&, std::size_t value);
    const std::string& value_of(const Variant& variant) const { return values.at(get(variant)); }
};

const std::vector<VariantAxis>& variant_axes();
/// The value of the axis of this name.
const std::string& variant_value(const std::string& axis, const Variant& variant);
bool is_variant_axis(const std::string& name);

/// The part that an image depends on: launched as usual, film in a buffer.
Variant of_image(const Variant& variant);
/// The rest: where the film lies and how work is launched, of which no bit of the image may depend.
Variant of_launch(const Variant& variant);

/// What is not the default: "queue out_of_order, rng park_miller", or nothing.
std::string to_string(const Variant& variant);

}  // namespace ptb
