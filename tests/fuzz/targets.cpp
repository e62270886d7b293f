#include "tests/fuzz/targets.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/compare/gate_file.h"
#include "bench/compare/sessions.h"
#include "bench/plan/config.h"
#include "bench/record/fingerprint.h"
#include "bench/record/journal.h"
#include "bench/record/json.h"
#include "bench/record/result_file.h"
#include "bench/report/changes.h"
#include "bench/report/csv.h"
#include "bench/report/table.h"
#include "bench/worker/probe.h"
#include "bench/worker/protocol.h"
#include "core/input/usage_error.h"
#include "core/mesh/mesh_file.h"
#include "core/scene/scene.h"

namespace ptb::fuzz {
namespace {

const std::string origin = "input";

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

/// Whether `read` accepts; its only other way out is an Error of one line.
template <class Error, class Read>
bool accepted(const Read& read) {
    try {
        read();
        return true;
    } catch (const Error& error) {
        const std::string_view line = error.what();
        require(!line.empty() && line.find('\n') == line.npos, "a refusal is one line");
        return false;
    }
}

/// What a result file is used for.
void show(const ResultFile& result) {
    csv(result);
    csv_samples(result);
    table(result, {});
    fingerprint_of(result);
}

void compare(const Session& session) {
    const CompareRules rules{[](const SessionCase&) { return 0.05; }, false, true};
    for (const Comparison& each : {compare_sessions({session}, {session}, rules),
                                   compare_history({session, session}, session, rules)}) {
        comparison_text(each);
        to_text(changes_section(each.rows, "fuzz"));
    }
}

void feed_result(std::string_view bytes) {
    accepted<UsageError>([&] { compare(parse_session(bytes, origin)); });
    accepted<UsageError>([&] { rows_of(parse_gate(bytes, origin)); });
    accepted<UsageError>([&] {
        const ResultFile result = result_from_json(parse_json(bytes, origin), origin);
        show(result);
        const auto text = result_text(result);
        require(result_text(result_from_json(parse_json(text, origin), origin)) == text,
                "a result reads back to the same text");
    });
}

void feed_journal(std::string_view bytes) {
    accepted<UsageError>([&] { result_text(parse_journal(bytes, origin)); });
}

void feed_config(std::string_view bytes) {
    accepted<UsageError>([&] {
        const Config config = parse_config(bytes, origin);
        require(parse_config(dump_config(config), origin) == config, "a config reads back to the same value");
        expand(config, {DeviceInfo()});
    });
}

void require_whole(const Mesh& mesh) {
    require(!mesh.faces.empty(), "a mesh has faces");
    for (const Face& face : mesh.faces)
        for (const std::uint32_t vertex : face)
            require(vertex < mesh.vertices.size(), "a face has vertices that there are");
}

void feed_scene(std::string_view bytes) {
    accepted<UsageError>([&] {
        const Scene scene = parse_scene(bytes, origin, {.folder = "no folder", .most_triangles = 10'000});
        require(triangle_count(scene) <= 10'000, "a scene has no more triangles than it may");
        for (const Mesh& mesh : scene.meshes) require_whole(mesh);
        for (const Sphere& sphere : scene.spheres)
            require(sphere.radius > 0 && sphere.material < static_cast<int>(scene.materials.size()),
                    "a sphere has a radius and a material");
    });
}

/// The first byte says which format the others are.
void feed_mesh(std::string_view bytes) {
    static const std::vector<std::string> extensions = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    if (bytes.empty()) return;
    const std::string& extension = extensions[static_cast<unsigned char>(bytes[0]) % extensions.size()];
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("ptbench_fuzz_{}{}", ::getpid(), extension);
    std::ofstream(file, std::ios::binary) << bytes.substr(1);
    accepted<UsageError>([&] {
        const MeshFile mesh = read_mesh_file(file, {.most_triangles = 10'000});
        require(!mesh.geometry.faces().empty(), "a mesh has faces");
        for (const Face& face : mesh.geometry.faces())
            for (const std::uint32_t vertex : face)
                require(vertex < mesh.geometry.vertices().size(), "a face has vertices that there are");
        loose_edge(mesh.geometry);
        files_of_mesh(file);
    });
    std::filesystem::remove(file);
}

void feed_protocol(std::string_view bytes) {
    const std::string line(bytes);
    accepted<std::runtime_error>([&] {
        const auto text = to_line(parse_request(line));
        require(to_line(parse_request(text)) == text, "a request reads back to the same line");
    });
    accepted<std::runtime_error>([&] {
        const auto text = to_line(parse_response(line));
        require(to_line(parse_response(text)) == text, "a response reads back to the same line");
    });
    accepted<std::runtime_error>([&] { probe_line(parse_probe_line(line)); });
}

}  // namespace

const std::vector<Target>& targets() {
    static const std::vector<Target> all = {{"result", feed_result}, {"journal", feed_journal},
                                            {"config", feed_config}, {"scene", feed_scene},
                                            {"mesh", feed_mesh},     {"protocol", feed_protocol}};
    return all;
}

}  // namespace ptb::fuzz
