#include "simulation/elastic/bar_structure.h"

#include <utility>

namespace sweep_guard_simulation {

BarStructure::BarStructure(Eigen::MatrixX3d nodes)
    : rest(std::move(nodes)),
      masses(Eigen::VectorXd::Zero(rest.rows())),
      foundation(Eigen::VectorXd::Zero(rest.rows())),
      fixed(static_cast<size_t>(rest.rows()), false) {}

}  // namespace sweep_guard_simulation
