#include <bit>
#include <limits>
#include <memory>

#include <gmock/gmock.h>

#include "bench/validate/rays.h"
#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int count = 200;

Ray random_ray(Dice& dice) {
    Ray ray;
    for (std::size_t i = 0; i < 3; ++i) ray.origin[i] = dice.between(-1, 1);
    Vec3 to{dice.uniform() - 0.5, dice.uniform() - 0.5, dice.uniform() - 0.5};
    to = normalized(to);
    ray.direction = {static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z)};
    return ray;
}

/// Rays among scattered triangles with what they meet.
RaySample right_sample() {
    Dice dice(5);
    RaySample sample;
    const auto triangles = std::make_shared<Triangles>(with(room(1.5f), soup(3000, 0.1f)));
    sample.triangles = triangles;
    for (int i = 0; i < count; ++i) {
        const Ray ray = random_ray(dice);
        const Met met = look_everywhere(*triangles, ray);
        const auto& [o, d] = std::pair(ray.origin, ray.direction);
        sample.rays.push_back({{o[0], o[1], o[2], std::bit_cast<float>(TREE_NOTHING)},
                               {d[0], d[1], d[2], std::numeric_limits<float>::max()}});
        sample.hits.push_back({static_cast<float>(met.distance), met.number, 0, 0});
    }
    return sample;
}

Validation judged(const RaySample& sample) {
    Validation validation;
    validation.valid = true;
    check_rays(validation, sample);
    return validation;
}

TEST(RayCheck, what_rays_meet_is_found_right) {
    const Validation validation = judged(right_sample());
    EXPECT_TRUE(validation.valid) << validation.reason;
    EXPECT_THAT(validation.checks, testing::ElementsAre("rays"));
}

/// Each fault in one ray of many.
TEST(RayCheck, one_wrong_hit_is_found_and_told_with_its_ray) {
    const RaySample right = right_sample();
    const auto reason = [&](auto&& spoil) {
        RaySample wrong = right;
        spoil(wrong.rays[77], wrong.hits[77]);
        const Validation validation = judged(wrong);
        EXPECT_FALSE(validation.valid);
        return validation.reason;
    };
    const std::uint32_t met = right.hits[77].triangle;
    EXPECT_THAT(reason([](ListedRay&, ListedHit& hit) { hit.triangle = TREE_NOTHING; }),
                AllOf(HasSubstr("the ray from ("), HasSubstr("is told to meet nothing, but meets triangle")));
    EXPECT_THAT(reason([](ListedRay&, ListedHit& hit) { hit.distance *= 1.001f; }),
                HasSubstr(", which is at"));
    EXPECT_THAT(reason([](ListedRay&, ListedHit& hit) { hit.triangle ^= 1u; }),
                HasSubstr("which it passes by"));
    EXPECT_THAT(reason([](ListedRay&, ListedHit& hit) { hit.triangle = 1'000'000; }), HasSubstr("it cannot"));
    EXPECT_THAT(reason([&](ListedRay& ray, ListedHit&) { ray.origin_left.w = std::bit_cast<float>(met); }),
                HasSubstr("it cannot"));
    EXPECT_THAT(reason([&](ListedRay& ray, ListedHit& hit) { ray.direction_reach.w = 0.99f * hit.distance; }),
                HasSubstr("which it passes by"));
}

/// The wall behind what is nearer, at its own distance.
TEST(RayCheck, a_farther_triangle_is_found) {
    RaySample sample = right_sample();
    const auto triangles = std::make_shared<Triangles>(*sample.triangles);
    const ListedRay& ray = sample.rays[77];
    const auto &o = ray.origin_left, &d = ray.direction_reach;
    const float half = 0.5f * sample.hits[77].distance;
    const float x = o.x + half * d.x, y = o.y + half * d.y, z = o.z + half * d.z;
    triangles->push_back({{{{x - 0.01f, y, z}, {x + 0.01f, y + 0.01f, z}, {x, y - 0.01f, z + 0.01f}}}});
    sample.triangles = triangles;
    const Validation validation = judged(sample);
    EXPECT_FALSE(validation.valid);
    EXPECT_THAT(validation.reason, HasSubstr("but meets triangle"));
}

TEST(RayCheck, of_a_shadow_ray_any_triangle_in_reach_will_do_and_none_will_not) {
    RaySample sample = right_sample();
    sample.any = true;
    for (ListedHit& hit : sample.hits) hit.distance = 0;  // where is not asked
    EXPECT_TRUE(judged(sample).valid);
    sample.hits[3].triangle = TREE_NOTHING;
    EXPECT_THAT(judged(sample).reason, HasSubstr("is told to meet nothing, but meets"));
    sample.rays[3].direction_reach.w = 0;
    EXPECT_TRUE(judged(sample).valid) << "nothing is within its reach";
}

}  // namespace
}  // namespace ptb
