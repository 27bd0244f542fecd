// SPDX-License-Identifier: MIT
// The options and the help of the command scope.
#pragma once

#include "tools/commands.h"

namespace CLI {
class App;
}

namespace threefold {

void add_scope_options(CLI::App &command, ScopeCommand &scope);

} // namespace threefold
