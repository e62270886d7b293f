#include "core/render/variant.h"

#include <algorithm>

namespace ptb {

namespace {

template <auto member>
VariantAxis axis(const char* name, const char* help, std::vector<std::string> values) {
    return {name, help, std::move(values),
            [](const Variant& variant) { return static_cast<std::size_t>(variant.*member); },
            [](Variant& variant, std::size_t value) {
                using Choice = std::remove_reference_t<decltype(variant.*member)>;
                variant.*member = static_cast<Choice>(value);
            }};
}

Variant launched_as(Variant variant, const Variant& launch) {
    variant.film_memory = launch.film_memory;
    variant.queue = launch.queue;
    variant.dispatch = launch.dispatch;
    return variant;
}

}  // namespace

const std::vector<VariantAxis>& variant_axes() {
    static const std::vector<VariantAxis> axes{
        axis<&Variant::scene_memory>("scene_memory", "memory that rays read the spheres from",
                                     {"auto", "argument", "constant", "global", "local", "private"}),
        axis<&Variant::film_memory>("film_memory", "what holds the pixels' sums", {"buffer", "image"}),
        axis<&Variant::queue>("queue", "whether the launches of a pass wait for each other",
                              {"in_order", "out_of_order"}),
        axis<&Variant::dispatch>("dispatch", "one range of work-items, or many launches of one",
                                 {"ndrange", "tasks"}),
        axis<&Variant::pixel_filter>("pixel_filter", "where in its pixel a sample lies",
                                     {"jitter", "centre", "stratified"}),
        axis<&Variant::rng>("rng", "random numbers", {"auto", "hash", "park_miller"}),
        axis<&Variant::roulette>("roulette",
                                 "whether paths end at random, with what a surface does not reflect",
                                 {"off", "albedo"}),
        axis<&Variant::build>("build", "how freely the compiler may treat arithmetic",
                              {"default", "strict", "relaxed"}),
        axis<&Variant::bvh>("bvh",
                            "tree of a scene's triangles: two children a node, boxes of whole floats or (q) "
                            "quantised, or eight",
                            {"auto", "bvh2", "bvh2q", "wide8"}),
        axis<&Variant::bvh_split>("bvh_split", "how it is built: xyz parts boxes by place alone, not by size",
                                  {"spatial", "sah", "spatial_xyz", "sah_xyz"}),
        axis<&Variant::ray_kind>("ray_kind",
                                 "which rays the kernel rays lists: of the camera, or from there on",
                                 {"primary", "bounce1", "bounce3", "shadow"}),
        axis<&Variant::reconstruction>(
            "reconstruction",
            "how gradients become a picture: least squares, weighted by their variance or not; least "
            "absolute errors, biased; or not at all",
            {"weighted", "l2", "l1", "none"}),
    };
    return axes;
}

bool is_variant_axis(const std::string& name) {
    const auto& axes = variant_axes();
    return std::any_of(axes.begin(), axes.end(), [&](const VariantAxis& axis) { return axis.name == name; });
}

const std::string& variant_value(const std::string& axis, const Variant& variant) {
    const auto& axes = variant_axes();
    return std::find_if(axes.begin(), axes.end(), [&](const VariantAxis& each) { return each.name == axis; })
        ->value_of(variant);
}

Variant of_image(const Variant& variant) { return launched_as(variant, {}); }
Variant of_launch(const Variant& variant) { return launched_as({}, variant); }

std::string to_string(const Variant& variant) {
    std::string text;
    for (const VariantAxis& axis : variant_axes()) {
        if (axis.get(variant) == 0) continue;
        text += (text.empty() ? "" : ", ") + axis.name + " " + axis.value_of(variant);
    }
    return text;
}

}  // namespace ptb
