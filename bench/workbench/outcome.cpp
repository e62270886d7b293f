#include "bench/workbench/outcome.h"

#include "core/ocl/error.h"
#include "core/source/source.h"

namespace ptb {

void conclude(Record& record, Status status, const std::string& reason) {
    record.status = status;
    record.reason = reason;
    if (status == Status::ok || status == Status::unstable) return;
    record.samples.clear();
    record.statistics.reset();
    record.energy.reset();
    record.counted.reset();
    record.efficiency.reset();
    if (record.work) record.work->longest_launch_ns = 0;
    if (record.build) record.build->first_launch_ns = 0;
}

void conclude_by_image(Record& record) {
    if (!record.validation->valid)
        conclude(record, Status::invalid, record.validation->reason);
    else if (record.status != Status::unstable)
        conclude(record, Status::ok, "");
}

void conclude_attempt(Record& record, const std::function<void()>& attempt) {
    try {
        attempt();
    } catch (const Unsupported& e) {
        conclude(record, Status::unsupported, e.what());
    } catch (const ocl::BuildError& e) {
        if (record.build) record.build->log = e.log();
        conclude(record, Status::compile, e.what());
    } catch (const SourceError& e) {
        record.build = Build{};
        record.build->overridden = true;  // the embedded kernels are whole
        conclude(record, Status::compile, e.what());
    } catch (const std::exception& e) {
        conclude(record, Status::runtime, e.what());
    }
}

}  // namespace ptb
