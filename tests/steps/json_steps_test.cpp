// The work of reading, counted in steps that do not depend on the machine: twice the text is twice the work.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/input/json.h"
#include "core/scene/scene.h"

namespace ptb {
namespace {

/// `before`, then `element` so many times with commas between, then `after`.
std::string repeated(const std::string& before, const std::string& element, int times,
                     const std::string& after) {
    std::string text = before;
    for (int i = 0; i < times; ++i) text += (i == 0 ? "" : ",") + element;
    return text + after;
}

template <class Read>
std::size_t steps(Read&& read) {
    const std::size_t before = json_steps;
    read();
    return json_steps - before;
}

/// Eight times as much is eight times the work, over what there is anyway.
template <class Read>
void expect_linear(Read&& read) {
    const std::size_t least = steps([&] { read(1); }), some = steps([&] { read(100); });
    const std::size_t many = steps([&] { read(800); });
    ASSERT_GT(some, least);
    EXPECT_LT(many - least, 9 * (some - least)) << some << " and " << many << " steps";
}

TEST(JsonSteps, are_in_proportion_to_the_elements_of_a_list) {
    for (const std::string element : {"7", "\"word\"", "{\"spp\": 4, \"samples\": []}", "[[1], {}]"})
        expect_linear([&](int times) { parse_json(repeated("[", element, times, "]"), "list"); });
}

TEST(JsonSteps, are_in_proportion_to_the_keys_of_an_object) {
    expect_linear([](int times) {
        std::string members;
        for (int i = 0; i < times; ++i) members += fmt::format("{}\"key{}\": [{}]", i == 0 ? "" : ",", i, i);
        parse_json("{" + members + "}", "object");
    });
}

TEST(JsonSteps, of_a_scene_are_in_proportion_to_its_spheres) {
    expect_linear([](int times) {
        const Scene scene = parse_scene(
            repeated(R"({"name": "many", "materials": {"grey": {"type": "matte", "albedo": [1, 1, 1]}},
                         "camera": {"position": [0, 0, 0], "look_at": [0, 0, 1], "up": [0, 1, 0], "fov_deg": 9},
                         "spheres": [)",
                     R"({"centre": [1, 2, 3], "radius": 4, "material": "grey"})", times, "]}"),
            "scene");
        EXPECT_EQ(scene.spheres.size(), static_cast<std::size_t>(times));
    });
}

}  // namespace
}  // namespace ptb
