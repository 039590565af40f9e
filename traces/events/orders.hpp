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
inline constexpr Description description_of<ListInsert>{
    .name = "list_insert", .meaning = "a piece enters the list", .work = WorkKind::bookkeeping, .after_polygons = true};
template <>
inline constexpr auto fields_of<ListInsert> =
    Fields{Field{"piece", &ListInsert::piece, Measure::piece, "the piece", As::subject},
           Field{"place", &ListInsert::place, "index", "its place in the list, from the front, from 0", As::formula}};

template <>
inline constexpr Description description_of<ListRemove>{
    .name = "list_remove", .meaning = "a piece leaves the list", .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<ListRemove> =
    Fields{Field{"piece", &ListRemove::piece, Measure::piece, "the piece", As::subject}};

template <>
inline constexpr Description description_of<ListMark>{
    .name = "list_mark",
    .meaning = "a piece in the list is marked: it was moved once and may not be moved again",
    .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<ListMark> =
    Fields{Field{"piece", &ListMark::piece, Measure::piece, "the piece", As::subject}};

template <>
inline constexpr Description description_of<PairBegin>{
    .name = "pair_begin",
    .meaning = "two pieces are to be compared: may the one be drawn before the other?",
    .work = WorkKind::bookkeeping,
    .after_polygons = true};
template <>
inline constexpr auto fields_of<PairBegin> =
    Fields{Field{"piece", &PairBegin::piece, Measure::piece, "P", As::subject, Guess::told},
           Field{"other", &PairBegin::other, Measure::piece, "Q", As::subject, Guess::formula}};

template <>
inline constexpr Description description_of<RootCandidate>{
    .name = "root_candidate",
    .meaning = "a piece as the root of a subtree: how many of the others its plane would split",
    .work = WorkKind::tests,
    .within = Within::node,
    .after_polygons = true};
template <>
inline constexpr auto fields_of<RootCandidate> =
    Fields{Field{"piece", &RootCandidate::piece, Measure::piece, "the candidate", As::subject},
           Field{"splits", &RootCandidate::splits, "1", "pieces that its plane crosses", As::recorded}};

template <>
inline constexpr Description description_of<NodeMake>{.name = "node_make",
                                                      .meaning = "a node of the tree is made",
                                                      .work = WorkKind::bookkeeping,
                                                      .after_polygons = true};
template <>
inline constexpr auto fields_of<NodeMake> =
    Fields{Field{"node", &NodeMake::node, Measure::node, "the node, numbered in the order in which nodes are made",
                 As::made, Guess::next},
           Field{"parent", &NodeMake::parent, Measure::node, "the node above it, -1 for the root", As::subject},
           Field{"front", &NodeMake::front, "1", "it hangs at the front side of that node", As::subject},
           Field{"piece", &NodeMake::piece, Measure::piece, "the piece whose plane divides space here", As::input}};

template <>
inline constexpr Description description_of<NodeAdd>{
    .name = "node_add", .meaning = "a piece that lies in a node's plane joins the node", .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<NodeAdd> =
    Fields{Field{"node", &NodeAdd::node, Measure::node, "the node", As::subject},
           Field{"piece", &NodeAdd::piece, Measure::piece, "the piece", As::subject}};

template <>
inline constexpr Description description_of<EyeSide>{.name = "eye_side",
                                                     .meaning = "the eye is held against a node's plane",
                                                     .work = WorkKind::tests,
                                                     .called = "the eye against the plane of node {node}"};
template <>
inline constexpr auto fields_of<EyeSide> =
    Fields{Field{"node", &EyeSide::node, Measure::node, "the node", As::subject},
           Field{"value", &EyeSide::value, "1",
                 "A x + B y + C z + D w at the eye (x, y, z, w); w = 0 where the eye is a direction", As::formula},
           Field{"front", &EyeSide::front, "1", "the eye is in front", As::formula}};

template <>
inline constexpr Description description_of<NodeSkip>{
    .name = "node_skip",
    .meaning = "a subtree is passed over because the view volume does not reach it",
    .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<NodeSkip> =
    Fields{Field{"node", &NodeSkip::node, Measure::node, "the node above it", As::subject},
           Field{"front", &NodeSkip::front, "1", "it is the one at the front side", As::subject},
           Field{"value", &NodeSkip::value, "1",
                 "A x + B y + C z + D at the corner of the view volume that comes nearest to that side", As::recorded}};

}  // namespace zstep
