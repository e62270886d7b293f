#pragma once

namespace ptb {

/// Registers the host's hot spots: validation, JSON, statistics, trees.
void register_host();

/// Registers every kernel on every device of this process.
void register_renders();

}  // namespace ptb
