#include "bench/report/ranking.h"

#include <gmock/gmock.h>

#include "bench/plan/config.h"

namespace ptb {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

Record timed(const std::string& device, const std::string& kernel, int spp, double msegments_per_s) {
    Record r;
    r.params = default_case();
    r.params.device = device;
    r.params.kernel = kernel;
    r.params.size = {100, 100};
    r.params.spp = spp;
    r.status = Status::ok;
    r.statistics = Statistics{};
    r.statistics->median_ns = 1e6;
    r.statistics->ci_low_ns = 0.8e6;
    r.statistics->ci_high_ns = 1.25e6;
    r.statistics->msegments_per_s = msegments_per_s;
    r.work = Work{};
    r.work->samples = 100;
    r.work->segments = 3000;
    return r;
}

ResultFile run(std::vector<Record> records) {
    ResultFile f;
    for (const Record& record : records) {
        DeviceInfo device;
        device.key = record.params.device;
        device.name = "device " + device.key;
        if (f.devices.empty() || f.devices.back().key != device.key) f.devices.push_back(device);
    }
    f.cases = std::move(records);
    return f;
}

PublishedTable table_1() {
    PublishedTable table{2016, "a thesis", "thesis", default_case().scene, {}};
    table.rows = {{"AMD", "GPU", "old", 10, 100, {1000, 1000}, default_case().path_length},
                  {"AMD", "GPU", "old", 1000, 30000, {1000, 1000}, default_case().path_length}};
    return table;
}

auto stands(const std::string& device, double value) {
    return AllOf(Field(&Standing::device, device),
                 Field(&Standing::value, testing::DoubleNear(value, 1e-6 * value)));
}

TEST(ranking, devices_of_all_runs_stand_by_their_case_of_the_most_samples) {
    const ResultFile one = run({timed("a", "pt", 10, 900), timed("a", "pt", 1000, 500)}),
                     other = run({timed("b", "pt", 100, 700), timed("b", "pt", 10, 100)});
    const auto all = rankings({&one, &other}, {});
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].title, "pt");
    EXPECT_THAT(all[0].standings, ElementsAre(stands("device b", 700), stands("device a", 500)));
    EXPECT_EQ(all[0].standings[1].detail, "1000 samples per pixel at 100x100");
    EXPECT_EQ(all[0].standings[0].run, 1u);
    EXPECT_DOUBLE_EQ(all[0].standings[1].interval->low, 400);
    EXPECT_DOUBLE_EQ(all[0].standings[1].interval->high, 625);
}

TEST(ranking, published_devices_stand_by_the_segments_that_their_kernel_traces) {
    const ResultFile f = run({timed("a", "pt", 10, 5000), timed("a", "thesis", 10, 500)});
    const auto all = rankings({&f}, table_1());
    ASSERT_EQ(all.size(), 2u);
    // A thousand million samples of 30 segments in 30 s.
    EXPECT_THAT(all[0].standings, ElementsAre(stands("device a", 5000), stands("old (2016)", 1000)));
    EXPECT_THAT(all[1].standings, ElementsAre(stands("old (2016)", 1000), stands("device a", 500)));
    EXPECT_FALSE(all[0].standings[1].run);
    EXPECT_THAT(all[0].note, HasSubstr("2016"));
}

TEST(ranking, published_devices_have_no_place_in_other_work) {
    ResultFile f = run({timed("a", "pt", 10, 5000), timed("a", "thesis", 10, 500)});
    for (Record& record : f.cases) record.params.path_length = 5;
    EXPECT_THAT(rankings({&f}, table_1()).at(0).standings, ElementsAre(stands("device a", 5000)));
}

TEST(ranking, unusual_work_is_not_mixed_with_the_usual) {
    Record unusual = timed("a", "pt", 100000, 9999);
    unusual.params.scene = "furnace";
    const ResultFile f = run({unusual, timed("a", "pt", 10, 500)});
    EXPECT_THAT(rankings({&f}, {}).at(0).standings, ElementsAre(stands("device a", 500)));
}

TEST(ranking, a_kernel_that_does_not_do_the_usual_work_is_ranked_by_that_of_the_most_devices) {
    const auto of_length_8 = [](Record record, const std::string& scene) {
        record.params.scene = scene;
        record.params.path_length = 8;
        return record;
    };
    const ResultFile f =
        run({timed("a", "pt", 10, 500), of_length_8(timed("a", "pt", 1000, 9999), "gap"),
             of_length_8(timed("a", "bdpt", 10, 1), default_case().scene),
             of_length_8(timed("a", "bdpt", 10, 40), "gap"), of_length_8(timed("b", "bdpt", 10, 30), "gap")});
    const auto all = rankings({&f}, table_1());
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].work, "scene thesis, path length 128");
    EXPECT_EQ(all[1].title, "bdpt, gap");
    EXPECT_EQ(all[1].work, "scene gap, path length 8");
    EXPECT_THAT(all[1].standings, ElementsAre(stands("device a", 40), stands("device b", 30)));
}

TEST(ranking, triangles_have_rankings_of_their_own) {
    const auto of_triangles = [](Record record, int path_length) {
        record.params.scene = "flake";
        record.params.path_length = path_length;
        record.tree = TreeRecord{};
        return record;
    };
    const ResultFile f = run({timed("a", "pt", 10, 500), of_triangles(timed("a", "pt", 10, 200), 10),
                              of_triangles(timed("a", "rays", 1, 300), 1)});
    const auto all = rankings({&f}, {});
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].title, "pt");
    EXPECT_EQ(all[1].title, "pt, flake");
    EXPECT_EQ(all[1].work, "scene flake, path length 10");
    EXPECT_THAT(all[1].standings, ElementsAre(stands("device a", 200)));
    EXPECT_EQ(all[2].title, "rays, flake");
    EXPECT_EQ(all[2].unit, "Mrays/s");
}

TEST(ranking, efficiencies_of_unlike_sizes_are_of_a_megapixel) {
    Record record = timed("a", "pt", 10, 500);
    record.efficiency = Efficiency{Noise{0.1, 0, 200, 180, 220}, std::nullopt, "film", ""};
    const ResultFile f = run({record});
    const auto all = rankings({&f}, {});
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[1].title, "pt, efficiency");
    EXPECT_THAT(all[1].standings, ElementsAre(stands("device a", 2)));
}

TEST(ranking, efficiencies_are_of_kernels_that_make_the_same_picture) {
    std::vector<Record> records;
    for (const std::string kernel : {"thesis", "whitted", "pt_nee", "pt_lt"}) {
        records.push_back(timed("a", kernel, 10, 500));
        if (kernel != "thesis")
            records.back().efficiency = Efficiency{Noise{0.1, 0, 200, 180, 220}, std::nullopt, "film", ""};
    }
    const auto titles_of = [](const std::vector<Record>& of) {
        const ResultFile f = run(of);
        std::vector<std::string> titles;
        for (const Ranking& each : rankings({&f}, {})) titles.push_back(each.title);
        return titles;
    };
    EXPECT_THAT(titles_of(records), ElementsAre("thesis", "whitted", "pt_nee", "pt_lt", "pt_nee, efficiency",
                                                "pt_lt, efficiency"));
    records.resize(2);
    EXPECT_THAT(titles_of(records), ElementsAre("thesis", "whitted", "whitted, efficiency"));
}

TEST(ranking, energies_are_of_segments) {
    Record record = timed("a", "pt", 10, 500);
    record.energy = Energy{"NVML", "", 1, 2, 1e6, std::nullopt};
    const ResultFile f = run({record});
    const auto all = rankings({&f}, {});
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[1].title, "pt, per joule");
    EXPECT_THAT(all[1].standings, ElementsAre(stands("device a", 30)));
}

TEST(ranking, nothing_timed_ranks_nothing) {
    const ResultFile f;
    EXPECT_TRUE(rankings({&f}, table_1()).empty());
}

}  // namespace
}  // namespace ptb
