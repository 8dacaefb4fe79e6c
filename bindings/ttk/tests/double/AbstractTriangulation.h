#pragma once

#include <array>
#include <string>
#include <vector>

// Stands in for the header of this name in TTK, so that the adapter compiles and is tested without it: the same names
// and signatures of what the adapter overrides and calls, and nothing behind them. As in TTK, the functions that users
// call are virtual and lead to others named ...Internal; TTK_ENABLE_KAMIKAZE decides which of the two are overridden.

#ifdef TTK_ENABLE_KAMIKAZE
#define TTK_TRIANGULATION_INTERNAL(NAME) NAME
#else
#define TTK_TRIANGULATION_INTERNAL(NAME) NAME##Internal
#endif

namespace ttk {

using SimplexId = int;
using LongSimplexId = long long int;

class AbstractTriangulation {
 public:
  virtual ~AbstractTriangulation() = default;

  int clear() { return 0; }
  void setDebugMsgPrefix(const std::string& prefix) { prefix_ = prefix; }
  int setThreadNumber(int threads) {
    threadNumber_ = threads;
    return 0;
  }
  int printErr(const std::string& message) const {
    printed.push_back(message);
    return 0;
  }
  mutable std::vector<std::string> printed;  ///< not TTK's: what would be on the screen

  virtual bool isEmpty() const { return true; }
  virtual bool isManifold() const { return isManifold_; }

#define DOUBLE_COUNT(Name)                                    \
  virtual SimplexId Name() const { return Name##Internal(); } \
  virtual SimplexId Name##Internal() const { return 0; }
  DOUBLE_COUNT(getNumberOfVertices)
  DOUBLE_COUNT(getNumberOfEdges)
  DOUBLE_COUNT(getNumberOfTriangles)
  DOUBLE_COUNT(getNumberOfCells)
  DOUBLE_COUNT(getDimensionality)
#undef DOUBLE_COUNT

#define DOUBLE_SIZE(Name)                                                                    \
  virtual SimplexId Name(const SimplexId& simplex) const { return Name##Internal(simplex); } \
  virtual SimplexId Name##Internal(const SimplexId&) const { return 0; }
#define DOUBLE_ENTRY(Name)                                                           \
  virtual int Name(const SimplexId& simplex, const int& i, SimplexId& found) const { \
    return Name##Internal(simplex, i, found);                                        \
  }                                                                                  \
  virtual int Name##Internal(const SimplexId&, const int&, SimplexId&) const { return 0; }
#define DOUBLE_LIST(Name, Type)                                        \
  virtual const std::vector<Type>* Name() { return Name##Internal(); } \
  virtual const std::vector<Type>* Name##Internal() { return nullptr; }
#define DOUBLE_ROWS(One, Many) \
  DOUBLE_SIZE(get##One##Number) DOUBLE_ENTRY(get##One) DOUBLE_LIST(get##Many, std::vector<SimplexId>)
  DOUBLE_ROWS(VertexNeighbor, VertexNeighbors)
  DOUBLE_ROWS(VertexEdge, VertexEdges)
  DOUBLE_ROWS(VertexTriangle, VertexTriangles)
  DOUBLE_ROWS(VertexStar, VertexStars)
  DOUBLE_ROWS(VertexLink, VertexLinks)
  DOUBLE_ROWS(EdgeTriangle, EdgeTriangles)
  DOUBLE_ROWS(EdgeStar, EdgeStars)
  DOUBLE_ROWS(EdgeLink, EdgeLinks)
  DOUBLE_ROWS(TriangleEdge, TriangleEdges)
  DOUBLE_ROWS(TriangleStar, TriangleStars)
  DOUBLE_ROWS(TriangleLink, TriangleLinks)
  DOUBLE_ROWS(CellEdge, CellEdges)
  DOUBLE_ROWS(CellTriangle, CellTriangles)
  DOUBLE_ROWS(CellNeighbor, CellNeighbors)
  DOUBLE_SIZE(getCellVertexNumber)
  DOUBLE_ENTRY(getCellVertex)
  DOUBLE_ENTRY(getEdgeVertex)
  DOUBLE_ENTRY(getTriangleVertex)
  using Pair = std::array<SimplexId, 2>;
  using Triple = std::array<SimplexId, 3>;
  DOUBLE_LIST(getEdges, Pair)
  DOUBLE_LIST(getTriangles, Triple)
#undef DOUBLE_ROWS
#undef DOUBLE_LIST
#undef DOUBLE_ENTRY
#undef DOUBLE_SIZE

#define DOUBLE_FLAG(Name)                                                               \
  virtual bool Name(const SimplexId& simplex) const { return Name##Internal(simplex); } \
  virtual bool Name##Internal(const SimplexId&) const { return false; }
  DOUBLE_FLAG(isVertexOnBoundary)
  DOUBLE_FLAG(isEdgeOnBoundary)
  DOUBLE_FLAG(isTriangleOnBoundary)
#undef DOUBLE_FLAG

  virtual int getVertexPoint(const SimplexId& vertex, float& x, float& y, float& z) const {
    return getVertexPointInternal(vertex, x, y, z);
  }
  virtual int getVertexPointInternal(const SimplexId&, float&, float&, float&) const { return 0; }

#define DOUBLE_PRECONDITION(What)                                             \
  virtual int precondition##What() { return precondition##What##Internal(); } \
  virtual int precondition##What##Internal() { return 0; }
  DOUBLE_PRECONDITION(BoundaryEdges)
  DOUBLE_PRECONDITION(BoundaryTriangles)
  DOUBLE_PRECONDITION(BoundaryVertices)
  DOUBLE_PRECONDITION(CellEdges)
  DOUBLE_PRECONDITION(CellNeighbors)
  DOUBLE_PRECONDITION(CellTriangles)
  DOUBLE_PRECONDITION(Edges)
  DOUBLE_PRECONDITION(EdgeLinks)
  DOUBLE_PRECONDITION(EdgeStars)
  DOUBLE_PRECONDITION(EdgeTriangles)
  DOUBLE_PRECONDITION(Triangles)
  DOUBLE_PRECONDITION(TriangleEdges)
  DOUBLE_PRECONDITION(TriangleLinks)
  DOUBLE_PRECONDITION(TriangleStars)
  DOUBLE_PRECONDITION(VertexEdges)
  DOUBLE_PRECONDITION(VertexLinks)
  DOUBLE_PRECONDITION(VertexNeighbors)
  DOUBLE_PRECONDITION(VertexStars)
  DOUBLE_PRECONDITION(VertexTriangles)
  DOUBLE_PRECONDITION(Manifold)
#undef DOUBLE_PRECONDITION

 protected:
  int threadNumber_ = 1;
  bool isManifold_ = true;
  std::vector<std::array<SimplexId, 2>> edgeList_;
  std::vector<std::array<SimplexId, 3>> triangleList_;

 private:
  std::string prefix_;
};

}  // namespace ttk
