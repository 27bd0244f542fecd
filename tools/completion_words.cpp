// SPDX-License-Identifier: MIT
#include <set>

#include "exporter/export/format.h"
#include "tools/commands.h"
#include "tools/manual.h"
#include "verifier/gallery/figures.h"
#include "verifier/studies/extremes.h"

namespace threefold {

std::vector<CompletionWords> completion_words(const Shop &shop) {
    std::vector<std::string> scenes, claims, fault_names, formats, figures;
    std::set<std::string> parameters;
    for (const SceneRecipe &s : shop.scenes) {
        scenes.push_back(s.name);
        for (const ParameterSpec &p : s.parameters) parameters.insert(p.name + "=");
    }
    for (const Claim &c : shop.claims) claims.push_back(c.name);
    for (const FaultEntry &f : faults()) fault_names.emplace_back(f.name);
    for (const ExportFormatEntry &f : export_formats()) formats.emplace_back(f.name);
    for (const Figure &f : study_figures()) figures.push_back(f.number);

    std::vector<CompletionWords> all{
        {"gallery", "", figures},
        {"check", "", claims},
        {"scope", "", claims},
        {"", "--with", witness_names(), true},
        {"render", "--with", witness_names()},
        {"export", "--to", formats},
        {"", "--preset", {"text", "published"}},
        {"check", "--preset", {"text", "published", "both"}},
        {"scope", "--preset", {"text", "published", "both"}},
        {"", "--precision", {"float", "double"}},
        {"optics", "--precision", {"double", "quad"}},
        {"", "--transport", {"tree", "roulette"}},
        {"", "--sampler", {"sobol", "stratified", "random"}},
        {"", "--without", claims, true},
        {"", "--faults", fault_names, true},
        {"", "--sweeps", extreme_sweep_names(), true},
        {"", "--set", {parameters.begin(), parameters.end()}},
    };
    for (const char *command : {"show", "render", "export", "trade"}) all.push_back({command, "", scenes});
    return all;
}

} // namespace threefold
