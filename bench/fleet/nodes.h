#pragma once

#include <string>
#include <vector>

namespace ptb {

/// What this machine is called in a fleet: by Slurm, else by itself.
std::string this_node();

/// The nodes of a list as Slurm writes it: "n1,n[3-5,07],login". Throws UsageError naming `origin`.
std::vector<std::string> nodes_in(const std::string& list, const std::string& origin);

/// Sorted nodes as short as Slurm would write them: "n[1,3-5],login".
std::string node_list(const std::vector<std::string>& nodes);

/// Those of this machine's job of Slurm; nothing outside of one.
std::vector<std::string> nodes_of_job();

}  // namespace ptb
