// The orders in which pieces are drawn: the sorted list and the tree.
// Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <cstdint>

#include "traces/events/field.hpp"

namespace zstep {

// clang-format off

struct ListInsert { std::int32_t piece, place; };
struct ListRemove { std::int32_t piece; };
struct ListMark { std::int32_t piece; };
struct PairBegin { std::int32_t piece, other; };
struct RootCandidate { std::int32_t piece, splits; };
struct NodeMake { std::int32_t node, parent; bool front; std::int32_t piece; };
struct NodeAdd { std::int32_t node, piece; };
struct EyeSide { std::int32_t node; double value; bool front; };
struct NodeSkip { std::int32_t node; bool front; double value; };

// clang-format on

template <>
inline constexpr KindText kind_text<ListInsert>{"list_insert", "a piece enters the list"};
template <>
inline constexpr auto fields_of<ListInsert> =
    Fields{Field{"piece", &ListInsert::piece, "index", "the piece"},
               Field{"place", &ListInsert::place, "index", "its place in the list, from the front, from 0"}};

template <>
inline constexpr KindText kind_text<ListRemove>{"list_remove", "a piece leaves the list"};
template <>
inline constexpr auto fields_of<ListRemove> = Fields{Field{"piece", &ListRemove::piece, "index", "the piece"}};

template <>
inline constexpr KindText kind_text<ListMark>{
    "list_mark", "a piece in the list is marked: it was moved once and may not be moved again"};
template <>
inline constexpr auto fields_of<ListMark> = Fields{Field{"piece", &ListMark::piece, "index", "the piece"}};

template <>
inline constexpr KindText kind_text<PairBegin>{"pair_begin",
                                               "two pieces are to be compared: may the one be drawn before the other?"};
template <>
inline constexpr auto fields_of<PairBegin> = Fields{Field{"piece", &PairBegin::piece, "index", "P", Guess::told},
                                                    Field{"other", &PairBegin::other, "index", "Q", Guess::formula}};

template <>
inline constexpr KindText kind_text<RootCandidate>{
    "root_candidate", "a piece as the root of a subtree: how many of the others its plane would split"};
template <>
inline constexpr auto fields_of<RootCandidate> =
    Fields{Field{"piece", &RootCandidate::piece, "index", "the candidate"},
               Field{"splits", &RootCandidate::splits, "1", "pieces that its plane crosses"}};

template <>
inline constexpr KindText kind_text<NodeMake>{"node_make", "a node of the tree is made"};
template <>
inline constexpr auto fields_of<NodeMake> = Fields{
    Field{"node", &NodeMake::node, "index", "the node, numbered in the order in which nodes are made", Guess::next},
    Field{"parent", &NodeMake::parent, "index", "the node above it, -1 for the root"},
    Field{"front", &NodeMake::front, "1", "it hangs at the front side of that node"},
    Field{"piece", &NodeMake::piece, "index", "the piece whose plane divides space here"}};

template <>
inline constexpr KindText kind_text<NodeAdd>{"node_add", "a piece that lies in a node's plane joins the node"};
template <>
inline constexpr auto fields_of<NodeAdd> = Fields{Field{"node", &NodeAdd::node, "index", "the node"},
                                                      Field{"piece", &NodeAdd::piece, "index", "the piece"}};

template <>
inline constexpr KindText kind_text<EyeSide>{"eye_side", "the eye is held against a node's plane"};
template <>
inline constexpr auto fields_of<EyeSide> =
    Fields{Field{"node", &EyeSide::node, "index", "the node"},
               Field{"value", &EyeSide::value, "1",
                     "A x + B y + C z + D w at the eye (x, y, z, w); w = 0 where the eye is a direction"},
               Field{"front", &EyeSide::front, "1", "the eye is in front"}};

template <>
inline constexpr KindText kind_text<NodeSkip>{"node_skip",
                                              "a subtree is passed over because the view volume does not reach it"};
template <>
inline constexpr auto fields_of<NodeSkip> =
    Fields{Field{"node", &NodeSkip::node, "index", "the node above it"},
               Field{"front", &NodeSkip::front, "1", "it is the one at the front side"},
               Field{"value", &NodeSkip::value, "1",
                     "A x + B y + C z + D at the corner of the view volume that comes nearest to that side"}};

}  // namespace zstep
