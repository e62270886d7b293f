#include "bench/worker/session.h"

#include <limits>
#include <optional>

#include <fmt/format.h>

#include "bench/measure/clock.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "bench/workbench/outcome.h"
#include "bench/workbench/workbench.h"
#include "bench/worker/picture.h"
#include "bench/worker/shared_pixels.h"
#include "core/input/usage_error.h"
#include "core/ocl/error.h"
#include "core/scene/content.h"

namespace ptb {

namespace {

constexpr double quiet_s = 0.1;  ///< between two signs of life

Response failed(const std::string& reason) {
    Response response;
    response.kind = Response::Kind::failed;
    response.reason = reason;
    return response;
}

Response refused(const std::string& reason) {
    Response response;
    response.kind = Response::Kind::refused;
    response.reason = reason;
    return response;
}

/// Sends an image; what goes wrong with it is seen by the rows that are missing, and costs nothing else.
void send_pixels(const Image& image, const WorkerSession::Send& send) {
    try {
        send_rows(image, [&](int first_row, const std::string& rgb) {
            Response response;
            response.kind = Response::Kind::pixels;
            response.first_row = first_row;
            response.rgb = rgb;
            send(response);
        });
    } catch (const std::exception&) {
    }
}

/// Why the scene of a request is not the one that was meant, or empty.
std::string other_scene(const Request& request) {
    if (request.scene_hash.empty()) return {};
    const std::string& scene = request.params.scene;
    const std::string hash = scene_hash(scene_file(scene, data_dir()));
    if (hash == request.scene_hash) return {};
    return fmt::format("scene {}: found the content {} where the worker is; allowed: {}", scene, hash,
                       request.scene_hash);
}

class DeviceSession : public WorkerSession {
  public:
    DeviceSession(std::string key, StopAsked stop_asked)
        : key_(std::move(key)), stop_asked_(std::move(stop_asked)) {}

    void answer(const Request& request, const Send& send) override {
        try {
            send(answered(request, send));
        } catch (const ocl::Error& e) {
            Response response = failed(e.what());
            response.device_failed = true;
            send(response);
        } catch (const std::exception& e) {
            send(failed(e.what()));
        }
    }

  private:
    Response answered(const Request& request, const Send& send) {
        if (request.kind == Request::Kind::open) return open(request, send);
        if (!bench_) return failed("the first request must be open");
        const std::string other = other_scene(request);
        if (!other.empty()) return failed(other);
        if (request.kind == Request::Kind::estimate) return estimate(request);
        if (request.kind == Request::Kind::render) return render(request, send);
        if (request.kind == Request::Kind::share_picture) return share(request, send);
        if (request.kind == Request::Kind::render_parts) return render_parts(request, send);
        if (request.kind == Request::Kind::give_film) return give_film();
        return request.kind == Request::Kind::peaks ? peaks(send) : measure(request, send);
    }

    Response open(const Request& request, const Send& send) {
        told(send)("open", 0);
        if (request.protocol != protocol_version)
            return failed("protocol " + std::to_string(request.protocol) + ", this worker speaks " +
                          std::to_string(protocol_version));
        options_ = request.measure;
        bench_.emplace(key_, options_, data_dir());
        Response response;
        response.kind = Response::Kind::ready;
        response.facts = facts_here(options_.kernel_dir);
        return response;
    }

    Response estimate(const Request& request) {
        Response response;
        response.kind = Response::Kind::estimate;
        try {
            response.ns_per_sample = bench_->estimate(request.params);
        } catch (const Unsupported& error) {
            response = refused(error.what());
        }
        return response;
    }

    static Stage told(const Send& send) {
        return [send, last_stage = std::string(), last_ns = std::int64_t{0}](const std::string& stage,
                                                                             double done) mutable {
            if (stage == last_stage && seconds_since(last_ns) < quiet_s) return;
            last_stage = stage;
            last_ns = now_ns();
            send(progress_response(stage, done));
        };
    }

    Response peaks(const Send& send) {
        Response response;
        response.kind = Response::Kind::peaks;
        response.peaks = bench_->peaks(told(send));
        return response;
    }

    Response render(const Request& request, const Send& send) {
        const auto progress = told(send);
        Response response;
        response.kind = Response::Kind::rendered;
        try {
            const Rendered rendered =
                bench_->picture(request.params, request.aov, request.time_s, [&](double done) {
                    progress("render", done);
                    return !stop_asked_(request.number);
                });
            send_pixels(rendered.image, send);
            response.whole = rendered.whole;
            response.spp = rendered.spp;
            response.seconds = rendered.seconds;
        } catch (const UsageError& error) {
            response = refused(error.what());
        } catch (const Unsupported& error) {
            response = refused(error.what());
        }
        return response;
    }

    Response share(const Request& request, const Send& send) {
        told(send)("build", 0);
        Response response;
        response.kind = Response::Kind::sharing;
        try {
            parts_.reset();  // frees the device's memory
            film_.emplace(request.film_file, request.params.size);
            parts_ = bench_->parts(request.params, request.cut);
            response.cut = parts_->cut();
            response.part_count = parts_->count();
            response.ns_per_sample = bench_->estimate(request.params);
        } catch (const UsageError& error) {
            response = refused(error.what());
        } catch (const Unsupported& error) {
            response = refused(error.what());
        }
        return response;
    }

    Response render_parts(const Request& request, const Send& send) {
        if (!parts_) return failed("there is no picture to make parts of");
        const auto progress = told(send);
        const PartsDone done = parts_->render(request.parts, [&](double share) {
            progress("render", share);
            return !stop_asked_(request.number);
        });
        Response response;
        response.kind = Response::Kind::parts_done;
        response.parts = done.parts;
        response.seconds = done.host_s;
        response.device_s = done.device_s;
        return response;
    }

    Response give_film() {
        if (!parts_) return failed("there is no film to give");
        Response response;
        response.kind = Response::Kind::film_given;
        response.film = parts_->take_film(film_->all());
        return response;
    }

    CaseResult measured(const Request& request, const Stage& stage) {
        if (request.kind == Request::Kind::round)
            return {bench_->round(request.params, request.samples, stage)};
        RunHow how{request.time_left_s.value_or(std::numeric_limits<double>::infinity()),
                   request.validate_only};
        if (request.beside_others) how.others_measure = [&] { return !stop_asked_(request.number); };
        return bench_->run(request.params, how, stage);
    }

    Response measure(const Request& request, const Send& send) {
        CaseResult result = measured(request, told(send));
        if (request.picture) send_pixels(result.picture, send);
        Response response;
        response.kind = Response::Kind::record;
        response.record = std::move(result.record);
        response.device_failed = response.record->status == Status::runtime;
        return response;
    }

    std::string key_;
    StopAsked stop_asked_;
    MeasureOptions options_;
    std::optional<Workbench> bench_;
    std::unique_ptr<PictureParts> parts_;  ///< of the picture that is being shared
    std::optional<SharedPixels> film_;     ///< its, where the coordinator reads it
};

}  // namespace

std::unique_ptr<WorkerSession> make_session(const std::string& device_key, StopAsked stop_asked) {
    return std::make_unique<DeviceSession>(device_key, std::move(stop_asked));
}

}  // namespace ptb
