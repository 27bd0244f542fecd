// SPDX-License-Identifier: MIT
// The named values of one element, each asked for once; what nobody asked for is told, never passed over.
#pragma once

#include <glm/mat4x4.hpp>
#include <initializer_list>
#include <optional>
#include <set>

#include "exporter/mitsuba/xml_tree.h"
#include "scenes/scene.h"

namespace threefold::mitsuba {

/// What cannot be read; what is read otherwise, so that the picture may be another; and what is left out without harm.
/// All with where it stands.
struct Findings {
    std::vector<std::string> problems, changes, notes;

    void problem(const Node &node, const std::string &what);
    void change(const Node &node, const std::string &what);
    void note(const Node &node, const std::string &what);
};

/// The file as a whole, for references and relative names.
struct Document {
    const Tree &tree;
    std::map<std::string, const Node *> by_id;
    Findings &findings;

    Document(const Tree &tree, Findings &findings);
    bool old_dialect() const { return tree.version < 2; }
};

/// <rotate>, <translate>, <scale>, <lookat> and <matrix>, in the file's order. `look` holds the last look-at's target
/// and up as the transforms after it leave them.
struct Transform {
    glm::dmat4 matrix{1};
    struct Look {
        Vec3 target, up;
    };
    std::optional<Look> look;
};

class Properties {
public:
    /// References among the children are followed. Names are taken in both spellings.
    Properties(const Node &element, Document &document);
    ~Properties() = default;
    Properties(const Properties &) = delete;

    const Node &element() const { return element_; }
    std::string type() const;

    /// Empty where it is absent, or is told as a problem.
    std::optional<double> number(const std::string &name);
    std::optional<int> whole(const std::string &name);
    bool boolean(const std::string &name, bool otherwise);
    std::string word(const std::string &name, const std::string &otherwise);
    std::optional<Vec3> point(const std::string &name);
    Transform transform(const std::string &name);
    /// A colour that is no texture.
    std::optional<Rgb> colour(const std::string &name);
    /// Any child of that name: a colour, or a texture's element.
    const Node *named(const std::string &name);
    /// Children of that tag without a claim yet.
    std::vector<const Node *> children(std::string_view tag);
    /// An index by number or by the name of a material.
    std::optional<double> index_of(const std::string &name, const std::string &otherwise);
    /// Told as a note: it changes how a picture is made, not what is in it.
    void leave_out(std::initializer_list<const char *> names, const std::string &why);

    /// Tells all that was not asked for.
    void finish();

private:
    struct Child {
        const Node *node;
        std::string name;
        bool used = false;
    };
    Child *find(const std::string &name);
    const std::string *value_of(const Node &node);

    const Node &element_;
    Document &document_;
    std::vector<Child> children_;
};

std::optional<double> to_number(std::string_view text);
/// Of a <rgb>, <srgb> or <spectrum> element; problems are told.
std::optional<Rgb> to_colour(const Node &node, Document &document);

} // namespace threefold::mitsuba
