// SPDX-License-Identifier: Apache-2.0
/// Validated: a layer that checks the rules of the contract and reports every one that a stream breaks.
///   In      any driver.  Out: the same driver, each stream checked before it is forwarded.
///   Fails   onError(Validation, "command 17 Draw in pass 'opaque': group 1 is not bound; ..."): command, object by its
///           debug name, the rule, the cure. A stream with errors is forwarded unless it could crash a real driver:
///           then the whole stream is dropped, which is reported as another error.
///   Memory  a model of all live objects, and 8 bytes per ticket ever used.
///   Thread  as the inner driver.
///   Cost    about 0.1 us per command; nothing if the layer is not used.
#pragma once

#include "backend/api/Driver.h"

#include <memory>

namespace filament_core::backend {

/// `sink` receives the broken rules and must outlive the result; the inner driver keeps its own sink.
std::unique_ptr<Driver> validate(std::unique_ptr<Driver> inner, ResultSink& sink);

} // namespace filament_core::backend
