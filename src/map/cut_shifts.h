// What:   the integer translations across the cuts, and every corner's coordinates in terms of them and of its vertex.
// Source: section 4, equation (1) and the elimination of integer variables.
// Differs: going once around a vertex must come back to the start; that is solved exactly, over the Gaussian integers, before any
//          solver sees the translations (docs/METHOD.md, "Grid map").
// Cost:   linear in the mesh, plus the number of cut paths times that of the vertices where more than two cut edges meet.
#pragma once

#include <cstdint>
#include <vector>

#include "base/transition.h"
#include "map/charts.h"

namespace inkgrid {

// The product of complex numbers.
constexpr IVec2 product(IVec2 a, IVec2 b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

// factor * shift, as complex numbers.
struct ShiftTerm {
  int shift;
  IVec2 factor;

  friend constexpr bool operator==(const ShiftTerm& a, const ShiftTerm& b) { return a.shift == b.shift && a.factor == b.factor; }
};
using ShiftForm = std::vector<ShiftTerm>;  // a sum; ascending shifts, no factor is zero

IVec2 value_of(const ShiftForm& form, const std::vector<IVec2>& shifts);

// All integer solutions of linear equations between complex unknowns:  unknown[k] = forms[k] of any integers.
class ShiftLattice {
 public:
  explicit ShiftLattice(int unknowns);
  // From now on this sum of unknowns is zero.
  void require_zero(const ShiftForm& sum);
  // A sum of unknowns as a sum of the free integers.
  ShiftForm resolve(const ShiftForm& sum) const;
  // The free integers, ascending; they are named by indices below the number of unknowns.
  std::vector<int> free_shifts() const;

 private:
  std::vector<ShiftForm> forms_;
  std::vector<char> free_;
};

// uv at a corner = i^corner_turn * (u, v of its vertex) + the form at corner_form.
struct CutShifts {
  int paths = 0;
  std::vector<int> shift_component;       // per free shift: the component of the mesh it belongs to
  std::vector<ShiftForm> forms;           // over the free shifts; none is empty
  std::vector<std::uint8_t> corner_turn;  // per corner
  std::vector<int> corner_form;           // per corner: index into forms, or -1: no translation
  std::vector<int> halfedge_form;         // per halfedge: the translation towards the twin's face, or -1: none
  std::vector<std::uint8_t> fixed_point;  // per vertex: 1 where it is the fixed point of its turns (a singular vertex)
  std::vector<int> doubled_form;          // per fixed point: twice its (u, v), or -1: zero; -1 elsewhere
};

// A cut path runs between vertices on the boundary, singular ones and those where other than two cut edges meet; its two sides
// differ by one turn and one translation.  Singular vertices are found from the turns themselves.
CutShifts trace_cuts(const BandMesh& mesh, const Charts& charts);

}  // namespace inkgrid
