// SPDX-License-Identifier: MIT
#include "exporter/mesh/obj_import.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/mesh/mesh_file.h"
#include "exporter/mesh/mesh_maker.h"

namespace threefold {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

class ObjReader {
public:
    explicit ObjReader(std::string text) : text_(std::move(text)) {}

    Mesh read() {
        std::string_view rest = text_;
        if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3); // the mark of UTF-8
        std::string joined;
        for (line_ = 1; !rest.empty(); ++line_) {
            std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(rest.size(), line.size() + 1));
            while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
            if (line.ends_with('\\') && !rest.empty()) { // goes on in the next line
                joined.append(line.substr(0, line.size() - 1)).push_back(' ');
                continue;
            }
            if (joined.empty()) {
                take(line);
            } else {
                take(joined.append(line));
                joined.clear();
            }
        }
        return made();
    }

private:
    struct Corner {
        std::int64_t place, uv; ///< from 0 on; uv -1: none
    };
    struct Face {
        std::size_t first, count, line;
    };

    [[noreturn]] void refuse(const std::string &why, std::size_t line) const {
        throw std::runtime_error(fmt::format("line {}: {}", line, why));
    }

    void take(std::string_view line) {
        words_.clear();
        for (std::size_t i = 0; i < line.size();) {
            while (i < line.size() && is_blank(line[i])) ++i;
            std::size_t end = i;
            while (end < line.size() && !is_blank(line[end])) ++end;
            if (end == i || line[i] == '#') break;
            words_.push_back(line.substr(i, end - i));
            i = end;
        }
        if (words_.empty()) return;
        if (words_[0] == "v") {
            if (words_.size() < 4) refuse("a vertex needs three numbers", line_);
            const Vec3 place(number(words_[1]), number(words_[2]), number(words_[3]));
            for (std::size_t k = 4; k < words_.size(); ++k) number(words_[k]); // a weight or a colour
            if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z))
                refuse(fmt::format("a vertex is not finite: ({}, {}, {})", place.x, place.y, place.z), line_);
            places_.push_back(place);
        } else if (words_[0] == "vt") {
            if (words_.size() < 2) refuse("a texture coordinate needs a number", line_);
            uvs_.push_back({number(words_[1]), words_.size() > 2 ? number(words_[2]) : 0});
        } else if (words_[0] == "f" || words_[0] == "fo") {
            face();
        } else if (words_[0] == "surf" || words_[0] == "call") {
            refuse(fmt::format("'{}' (free-form surfaces, other files) cannot be read", words_[0]), line_);
        }
    }

    void face() {
        faces_.push_back({corners_.size(), words_.size() - 1, line_});
        if (words_.size() > 3) triangles_ += static_cast<std::int64_t>(words_.size()) - 3;
        if (triangles_ > most_triangles)
            throw std::runtime_error(
                fmt::format("it has more than {} triangles, the most that Threefold takes", most_triangles));
        for (std::size_t k = 1; k < words_.size(); ++k) {
            const std::string_view word = words_[k];
            const std::size_t slash = word.find('/');
            Corner corner{index(word.substr(0, slash), places_.size()), -1};
            if (slash != std::string_view::npos) {
                const std::string_view after = word.substr(slash + 1), uv = after.substr(0, after.find('/'));
                if (!uv.empty()) corner.uv = index(uv, uvs_.size());
            }
            corners_.push_back(corner);
        }
    }

    /// Numbers of the format begin with 1; negative ones count back from what has been read.
    std::int64_t index(std::string_view word, std::size_t known) const {
        std::int64_t n = 0;
        const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), n);
        if (status != std::errc{} || end != word.data() + word.size() || n == 0)
            refuse(fmt::format("'{}' is no number of a vertex", word.substr(0, 40)), line_);
        if (n < 0 && -n > static_cast<std::int64_t>(known)) refuse("a face names a vertex that is not there", line_);
        return n > 0 ? n - 1 : static_cast<std::int64_t>(known) + n;
    }

    double number(std::string_view word) const {
        const std::string_view whole = word;
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0;
        const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty() || status == std::errc::invalid_argument || end != word.data() + word.size())
            refuse(fmt::format("'{}' is no number", whole.substr(0, 40)), line_);
        if (status == std::errc::result_out_of_range) // too great, or too small to be told from 0
            return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos ? 0
                                                                                                          : HUGE_VAL;
        return value;
    }

    Mesh made() const {
        const auto has_uv = [](const Corner &c) { return c.uv >= 0; };
        const bool with_uv = std::all_of(corners_.begin(), corners_.end(), has_uv);
        MeshMaker maker(corners_.size(), with_uv);
        std::vector<Vec3> places;
        std::vector<Vec2> uvs;
        for (const Face &face : faces_) {
            places.clear();
            uvs.clear();
            for (std::size_t k = face.first; k < face.first + face.count; ++k) {
                const Corner &c = corners_[k];
                if (c.place >= static_cast<std::int64_t>(places_.size()) ||
                    c.uv >= static_cast<std::int64_t>(uvs_.size()))
                    refuse("a face names a vertex that is not there", face.line);
                places.push_back(places_[static_cast<std::size_t>(c.place)]);
                if (with_uv) {
                    const Vec2 uv = uvs_[static_cast<std::size_t>(c.uv)];
                    uvs.push_back(uv_in_file(uv.x, uv.y));
                }
            }
            maker.add(places, uvs);
        }
        return maker.take();
    }

    std::string text_;
    std::size_t line_ = 0;
    std::vector<std::string_view> words_;
    std::vector<Vec3> places_;
    std::vector<Vec2> uvs_;
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
    std::int64_t triangles_ = 0;
};

} // namespace

Mesh import_obj(const std::string &path) { return ObjReader(read_file(path)).read(); }

} // namespace threefold
