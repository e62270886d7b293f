#include "bench/together/picture_folder.h"

#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "bench/plan/config.h"
#include "bench/together/hand_out.h"
#include "bench/worker/device_worker.h"
#include "core/render/render.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

TEST(Chunks, cover_all_parts_and_become_ever_smaller) {
    for (const std::size_t nodes : {1u, 2u, 100u}) {
        const std::vector<PartRange> chunks = chunks_of(1'000'000, 1000, nodes);
        std::uint64_t next = 0, before = 1'000'000;
        for (const PartRange& chunk : chunks) {
            EXPECT_EQ(chunk.first, next);
            EXPECT_LE(chunk.count(), before + 1000);
            before = chunk.count();
            next = chunk.end;
        }
        EXPECT_EQ(next, 1'000'000u);
        EXPECT_LE(chunks.front().count() * nodes, 500'000u) << "half of a share";
        EXPECT_LE(chunks.size(), 200 * nodes);
    }
    EXPECT_EQ(chunks_of(3, 1, 100).size(), 3u);
}

class PictureFolderTest : public testing::Test {
  protected:
    fs::path path_ = fs::temp_directory_path() / ("ptb_picture_folder_test_" + std::to_string(getpid()));
    PictureFolderTest() { fs::remove_all(path_); }
    ~PictureFolderTest() override { fs::remove_all(path_); }

    /// As a process of one of so many nodes has it.
    PictureFolder folder_for(std::size_t nodes) const {
        PictureFolder folder(path_);
        std::vector<std::string> differing;
        folder.join(picture(), nodes, differing);
        EXPECT_THAT(differing, testing::IsEmpty());
        return folder;
    }
    std::vector<std::string> films() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(path_ / "films"))
            if (entry.path().extension() == ".film") names.push_back(entry.path().filename());
        return names;
    }
    static PictureRanges picture() {
        PictureRanges ranges;
        ranges.params = default_case();
        ranges.params.size = {2, 1};
        ranges.facts = {{"kernel pt", "k"}, {"ptbench", "v"}};
        ranges.cut = {2, 3};
        ranges.part_count = 20;
        return ranges;
    }
    static FilmSums film(ptb_long radiance) {
        FilmSums sums{{{2, 1}, {0, 0}}, std::vector<FilmPixel>(2)};
        sums.pixels[0].radiance[0] = radiance;
        sums.pixels[0].samples = 1;
        return sums;
    }
};

TEST_F(PictureFolderTest, a_chunk_is_claimed_once) {
    PictureFolder one = folder_for(2), other = folder_for(7);
    std::vector<PartRange> claimed;
    for (auto mine = one.claim("n1"), theirs = other.claim("n2"); mine || theirs;
         mine = one.claim("n1"), theirs = other.claim("n2")) {
        if (mine) claimed.push_back(*mine);
        if (theirs) claimed.push_back(*theirs);
    }
    EXPECT_EQ(joined(claimed), (std::vector<PartRange>{{0, 20}}));
    EXPECT_EQ(claimed.size(), chunks_of(20, 2, 2).size());
}

TEST_F(PictureFolderTest, claims_without_a_film_are_given_up) {
    PictureFolder folder = folder_for(1);
    const PartRange kept = *folder.claim("n1");
    folder.leave("n1", film(5), {{"d:0", "D", "1", {kept}}});
    const PartRange lost = *folder.claim("n1");
    PictureFolder again = folder_for(1);
    again.give_up_claims("n1");
    EXPECT_EQ(again.claim("n1"), lost);
    again.leave("n1", film(7), {{"d:0", "D", "1", {lost}}});
    EXPECT_THAT(films(), testing::ElementsAre(fmt::format("n1.{}.film", kept.count() + lost.count())));
    EXPECT_EQ(again.merged().pixels[0].radiance[0], 12) << "both parts of the node's film";
    const auto made = again.made();
    ASSERT_EQ(made.size(), 2u);
    EXPECT_EQ(made[1].device, "n1/d:0");
}

TEST_F(PictureFolderTest, a_film_of_which_no_ranges_came_does_not_count) {
    PictureFolder folder = folder_for(1);
    const PartRange first = *folder.claim("n1");
    folder.leave("n1", film(5), {{"d:0", "D", "1", {first}}});
    fs::copy(path_ / "films", path_ / "before");
    const PartRange second = *folder.claim("n1");
    folder.leave("n1", film(7), {{"d:0", "D", "1", {second}}});
    // as a process leaves it that is killed before the ranges
    fs::copy(path_ / "before", path_ / "films",
             fs::copy_options::overwrite_existing | fs::copy_options::recursive);
    EXPECT_EQ(films().size(), 2u);
    EXPECT_EQ(folder.merged().pixels[0].radiance[0], 5);
    PictureFolder again = folder_for(1);
    again.give_up_claims("n1");
    EXPECT_EQ(again.claim("n1"), second);
    again.leave("n1", film(7), {{"d:0", "D", "1", {second}}});
    EXPECT_EQ(again.merged().pixels[0].radiance[0], 12);
}

TEST_F(PictureFolderTest, who_owes_what_was_claimed_is_known) {
    PictureFolder folder = folder_for(2);
    EXPECT_THAT(folder.owing(), testing::IsEmpty());
    const PartRange first = *folder.claim("n1");
    folder.claim("n2");
    EXPECT_THAT(folder.owing(), testing::ElementsAre("n1", "n2"));
    folder.leave("n1", film(5), {{"d:0", "D", "1", {first}}});
    EXPECT_THAT(folder.owing(), testing::ElementsAre("n2"));
}

TEST_F(PictureFolderTest, what_another_gives_up_is_claimed_by_who_passed_it) {
    PictureFolder one = folder_for(2), other = folder_for(2);
    const PartRange first = *one.claim("n1");
    while (other.claim("n2")) {
    }
    one.give_up_claims("n1");
    EXPECT_EQ(other.claim("n2"), first);
    EXPECT_FALSE(other.claim("n2"));
}

TEST_F(PictureFolderTest, of_a_chunk_that_is_made_in_part_the_rest_is_claimed) {
    PictureFolder one = folder_for(1), other = folder_for(1);
    const PartRange first = *one.claim("n1");
    ASSERT_GE(first.count(), 4u);
    const PartRange made{first.first + 1, first.end - 1};
    one.leave("n1", film(5), {{"d:0", "D", "1", {made}}});
    one.give_up_claims("n1");
    EXPECT_THAT(one.owing(), testing::IsEmpty());
    std::vector<PartRange> rest;
    while (const auto claimed = other.claim("n2")) rest.push_back(*claimed);
    EXPECT_EQ(joined(rest), (std::vector<PartRange>{{0, made.first}, {made.end, 20}}));
    other.leave("n2", film(7), {{"d:0", "D", "1", rest}});
    other.give_up_claims("n1");
    other.give_up_claims("n2");
    EXPECT_FALSE(one.claim("n1")) << "all is made";
}

TEST_F(PictureFolderTest, a_node_that_comes_again_adds_the_rest_of_its_own_chunk) {
    PictureFolder folder = folder_for(1);
    const PartRange first = *folder.claim("n1");
    folder.leave("n1", film(5), {{"d:0", "D", "1", {{first.first, first.end - 1}}}});
    PictureFolder again = folder_for(1);
    again.give_up_claims("n1");
    const PartRange rest{first.end - 1, first.end};
    EXPECT_EQ(again.claim("n1"), rest);
    again.leave("n1", film(7), {{"d:0", "D", "1", {rest}}});
    EXPECT_EQ(parts_made(again.made()), first.count());
    EXPECT_EQ(again.merged().pixels[0].radiance[0], 12);
}

TEST_F(PictureFolderTest, films_of_another_picture_are_refused_with_both_values) {
    PictureFolder folder = folder_for(1);
    std::vector<std::string> differing;
    folder.leave("n1", film(5), {{"d:0", "D", "1", {*folder.claim("n1")}}});
    fs::remove(path_ / "picture.json");
    PictureFolder next(path_);
    PictureRanges other = picture();
    other.seed = 9;
    next.join(other, 1, differing);
    try {
        next.made();
        FAIL() << "the film is of seed 1";
    } catch (const VersionMismatch& error) {
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("n1.json is of another picture: seed (there 1, here 9)"));
    }
}

TEST_F(PictureFolderTest, another_picture_differs) {
    PictureFolder folder = folder_for(1);
    std::vector<std::string> differing;
    PictureRanges other = picture();
    other.seed = 9;
    other.params.spp = 77;
    folder.join(other, 1, differing);
    EXPECT_EQ(differing.size(), 2u);
}

}  // namespace
}  // namespace ptb
