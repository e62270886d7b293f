#include "core/oracle/oracle.h"

namespace ptb {

const std::map<std::string, Tracer>& tracers() {
    static const std::map<std::string, Tracer> all{
        {"whitted", trace_whitted}, {"direct", trace_direct}, {"pt", trace_pt}, {"thesis", trace_thesis}};
    return all;
}

}  // namespace ptb
