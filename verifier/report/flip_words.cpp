// SPDX-License-Identifier: MIT
#include "verifier/report/flip_words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenes/parameters.h"
#include "verifier/report/numbers.h"

namespace threefold::report {

namespace {

std::string with_unit(std::string value, const FlipPoint &flip) {
    return flip.unit.empty() ? value : value + " " + flip.unit;
}

std::string five_digits(double value) {
    const double size = std::abs(value);
    if (!(size >= 1e-4 && size < 1e5)) return number(value, 5);
    std::string text = fmt::format("{:#.5g}", value);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::optional<double> parameter_of(const ExperimentRecord &e, const std::string &name) {
    const auto found = e.parameters.find(name);
    if (found == e.parameters.end()) return std::nullopt;
    return parse_number(found->second);
}

} // namespace

std::vector<BracketRender> bracket_renders(const ClaimResult &claim, const FlipPoint &flip) {
    std::vector<BracketRender> renders;
    for (const std::string &name : flip.bracket) {
        BracketRender render;
        render.experiment = name;
        const auto record = std::ranges::find(claim.experiments, name, &ExperimentRecord::name);
        if (record != claim.experiments.end()) render.at = parameter_of(*record, flip.parameter);
        for (const Row &row : claim.rows)
            if (row.experiment == name)
                render.verdict = render.verdict ? all_of(*render.verdict, row.verdict) : row.verdict;
        renders.push_back(render);
    }
    return renders;
}

std::optional<Verdict> bracket_verdict(const ClaimResult &claim, const FlipPoint &flip) {
    std::optional<Verdict> all;
    for (const BracketRender &render : bracket_renders(claim, flip)) {
        const Verdict verdict = render.verdict.value_or(Verdict::undecided);
        all = all ? all_of(*all, verdict) : verdict;
    }
    return all;
}

std::string flip_value(const FlipPoint &flip) { return with_unit(five_digits(flip.value), flip); }

std::string here_text(const FlipPoint &flip) {
    const std::string here = with_unit(number(flip.here, 6), flip);
    const double share = (flip.here - flip.value) / std::abs(flip.value);
    if (!std::isfinite(share)) return here;
    if (share == 0) return here + ", just there";
    return fmt::format("{}, {} {} it", here, percent(std::abs(share)), share > 0 ? "above" : "below");
}

std::string flip_line(const FlipPoint &flip) {
    return fmt::format("{} = {} (here {})", flip.parameter, flip_value(flip), here_text(flip));
}

std::string bracket_text(const ClaimResult &claim, const FlipPoint &flip) {
    std::string text;
    for (const BracketRender &render : bracket_renders(claim, flip))
        text += fmt::format("{}{}", text.empty() ? "at " : " and ",
                            render.at ? five_digits(*render.at) : render.experiment);
    return text.empty() || flip.unit.empty() ? text : text + " " + flip.unit;
}

} // namespace threefold::report
