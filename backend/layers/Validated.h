// SPDX-License-Identifier: Apache-2.0
/// Validated: a driver around a driver that knows the rules of the contract and names every one that a stream breaks.
///   In      any driver.  Out: the same driver, each stream checked before it is forwarded.
///   Fails   onError(Validation, "command 17 Draw in pass 'opaque': group 1 is not bound; ..."): command, object by its
///           debug name, the rule, the cure. A stream with errors is forwarded, unless a real driver could crash on it:
///           then the whole stream is dropped, which is an error of its own.
///   Memory  a model of all live objects, and 8 bytes for each ticket ever used.
///   Thread  as the driver inside.
///   Cost    about 0.1 us a command; nothing when the layer is not used.
#pragma once

#include "backend/api/Driver.h"

#include <memory>

namespace filament::backend {

/// `sink` gets the broken rules and must outlive the result; the inner driver keeps its own sink.
std::unique_ptr<Driver> validate(std::unique_ptr<Driver> inner, ResultSink& sink);

} // namespace filament::backend
