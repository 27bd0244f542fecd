// SPDX-License-Identifier: MIT
// The renderers that can be asked, our own tracer among them, and their pictures, cached by content.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "exporter/image/image.h"
#include "exporter/run.h"
#include "exporter/session.h"
#include "verifier/agreement/result.h"
#include "verifier/tracer/tracer.h"

namespace threefold {

struct Witness {
    std::string name, title, package;
    const Adapter *adapter = nullptr; ///< null: our own tracer
    std::optional<InstalledRenderer> installed;
    std::string problem; ///< why a program that is there cannot be used
    /// Where its pictures lie: they were made elsewhere, and are only read.
    std::optional<std::filesystem::path> pictures;

    bool present() const { return !adapter || installed; }
    bool is_tracer() const { return !adapter && !pictures; }
};

/// Those whose pictures can be made elsewhere: "mitsuba".
std::vector<std::string> elsewhere_names();
/// Error(usage) for another name.
Witness witness_elsewhere(const std::string &name, const std::filesystem::path &pictures);

/// Names in their order of appearance: tracer first.
std::vector<std::string> witness_names();
/// Looks in PATH for the asked ones; Error(usage) for an unknown name. A program that is
/// missing, or does not even tell its version, is no error here.
std::vector<Witness> find_witnesses(const std::vector<std::string> &names);

struct RenderOptions {
    std::filesystem::path folder; ///< of the run; each render gets a folder of its own under it
    std::string label;            ///< first part of that folder's name
    TracerSettings tracer;
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    std::function<void(double share)> on_progress;
    bool keep = true;             ///< pictures, for a later run; false where the folder goes away
    Sessions *sessions = nullptr; ///< of the calling thread: programs that are already running
};

struct Rendered {
    std::vector<Image> images;
    RenderRecord record;
};

/// Renders, or takes the pictures of an earlier run with the same content (inputs, version, settings). Pictures are
/// kept as lossless 64-bit TIFF; a kept render counts only once its `done.json` is there.
Rendered render(const Witness &witness, RenderJob job, const RenderOptions &options);

} // namespace threefold
