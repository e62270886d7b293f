#include "bench/worker/session.h"

#include <limits>
#include <optional>

#include "bench/measure/clock.h"
#include "bench/plan/data_dir.h"
#include "bench/version.h"
#include "bench/worker/workbench.h"
#include "core/ocl/error.h"

namespace ptb {

namespace {

constexpr double quiet_s = 0.1;  ///< between two signs of life

Response failed(const std::string& reason) {
    Response response;
    response.kind = Response::Kind::failed;
    response.reason = reason;
    return response;
}

class DeviceSession : public WorkerSession {
  public:
    explicit DeviceSession(std::string key) : key_(std::move(key)) {}

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
        if (request.kind == Request::Kind::open) return open(request);
        if (!bench_) return failed("the first request must be open");
        if (request.kind == Request::Kind::estimate) return estimate(request);
        return request.kind == Request::Kind::peaks ? peaks(send) : measure(request, send);
    }

    Response open(const Request& request) {
        if (request.protocol != protocol_version)
            return failed("protocol " + std::to_string(request.protocol) + ", this worker speaks " +
                          std::to_string(protocol_version));
        bench_.emplace(key_, request.measure, data_dir());
        Response response;
        response.kind = Response::Kind::ready;
        response.tool_version = version::tool;
        return response;
    }

    Response estimate(const Request& request) {
        Response response;
        response.kind = Response::Kind::estimate;
        response.ns_per_sample = bench_->estimate(request.params);
        return response;
    }

    static Workbench::Stage told(const Send& send) {
        return [send, last_stage = std::string(), last_ns = std::int64_t{0}](const std::string& stage,
                                                                             double done) mutable {
            if (stage == last_stage && seconds_since(last_ns) < quiet_s) return;
            last_stage = stage;
            last_ns = now_ns();
            Response response;
            response.kind = Response::Kind::progress;
            response.stage = stage;
            response.done = done;
            send(response);
        };
    }

    Response peaks(const Send& send) {
        Response response;
        response.kind = Response::Kind::peaks;
        response.peaks = bench_->peaks(told(send));
        return response;
    }

    Response measure(const Request& request, const Send& send) {
        const auto progress = told(send);
        Response response;
        response.kind = Response::Kind::record;
        const double time_left_s = request.time_left_s.value_or(std::numeric_limits<double>::infinity());
        response.record = request.kind == Request::Kind::round
                              ? bench_->round(request.params, request.samples, progress)
                              : bench_->run(request.params, time_left_s, request.image_file, progress);
        response.device_failed = response.record->status == Status::runtime;
        return response;
    }

    std::string key_;
    std::optional<Workbench> bench_;
};

}  // namespace

std::unique_ptr<WorkerSession> make_session(const std::string& device_key) {
    return std::make_unique<DeviceSession>(device_key);
}

}  // namespace ptb
