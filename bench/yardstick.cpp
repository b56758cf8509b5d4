// What:   the seconds that the two sparse systems of a drawing take a textbook solver: one factorisation and solve each.
// Source: the cost that no implementation of sections 6.1 and 6.2 is without, with Eigen's SimplicialLDLT, in one thread.
// Differs: -
// Cost:   that of the program, and a few factorisations.
//
// yardstick DRAWING THRESHOLD|auto REACH SPACING   prints JSON: CPU seconds, and the size of the mesh.
// `field` is the system of the paper, two complex unknowns a vertex; `field_real` the same system in the real form of
// field_system.h; `map` the relaxation of the mixed-integer problem, reals and integers.
#include <Eigen/SparseCholesky>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "field/field_system.h"
#include "images/image_io.h"
#include "map_problems.h"
#include "pipeline.h"

namespace inkgrid {
namespace {

using Complex = std::complex<double>;

template <class Scalar>
using Triplets = std::vector<Eigen::Triplet<Scalar>>;

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Seconds of ordering, factorising and solving.
template <class Scalar, int Columns>
double solve_seconds(int size, const Triplets<Scalar>& lower, const Eigen::Matrix<Scalar, Eigen::Dynamic, Columns>& right) {
  Eigen::SparseMatrix<Scalar> matrix(size, size);
  matrix.setFromTriplets(lower.begin(), lower.end());
  const double start = cpu_seconds();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Scalar>, Eigen::Lower> factor(matrix);
  const Eigen::Matrix<Scalar, Eigen::Dynamic, Columns> x = factor.solve(right);
  if (factor.info() != Eigen::Success || !x.allFinite()) throw Error(ErrorCode::numerics, "the yardstick's system is singular");
  return cpu_seconds() - start;
}

// Calls visit(i, j, block) for the blocks of the lower triangle.
template <class Visit>
void for_each_block(const PairMatrix& matrix, Visit visit) {
  for (int j = 0; j < matrix.size(); ++j) {
    visit(j, j, matrix.diagonal()[static_cast<std::size_t>(j)]);
    for (int k = matrix.starts()[static_cast<std::size_t>(j)]; k < matrix.starts()[static_cast<std::size_t>(j) + 1]; ++k)
      visit(matrix.rows()[static_cast<std::size_t>(k)], j, matrix.blocks()[static_cast<std::size_t>(k)]);
  }
}

template <class Scalar>
void add_lower(Triplets<Scalar>& lower, int row, int column, Scalar value) {
  if (row >= column) lower.emplace_back(row, column, value);
}

template <class Scalar>
void add_block(Triplets<Scalar>& lower, int i, int j, const std::array<Scalar, 4>& block) {
  for (int r : {0, 1})
    for (int c : {0, 1}) add_lower(lower, 2 * i + r, 2 * j + c, block[static_cast<std::size_t>(2 * r + c)]);
}

double complex_field_seconds(const FieldSystem& system) {
  Triplets<Complex> lower;
  for_each_block(system.matrix, [&](int i, int j, const Block& b) {
    // p = (c0 + c2) / 2 and q = (c0 - c2) / 2i.
    const double same = 0.25 * (b.a + b.d);
    const Complex mixed(0.25 * (b.a - b.d), 0.25 * (b.b + b.c)), skew(0, 0.25 * (b.c - b.b));
    add_block<Complex>(lower, i, j, {same + skew, mixed, std::conj(mixed), same - skew});
  });
  Eigen::VectorXcd right(2 * system.matrix.size());
  for (int i = 0; i < system.matrix.size(); ++i) {
    const ComplexPair& b = system.right[static_cast<std::size_t>(i)];
    right[2 * i] = 0.5 * (b.p + Complex(0, 1) * b.q);
    right[2 * i + 1] = 0.5 * (b.p - Complex(0, 1) * b.q);
  }
  return solve_seconds<Complex, 1>(2 * system.matrix.size(), lower, right);
}

double real_field_seconds(const FieldSystem& system) {
  Triplets<double> lower;
  for_each_block(system.matrix, [&](int i, int j, const Block& b) { add_block<double>(lower, i, j, {b.a, b.b, b.c, b.d}); });
  Eigen::Matrix<double, Eigen::Dynamic, 2> right(2 * system.matrix.size(), 2);
  for (int i = 0; i < system.matrix.size(); ++i) {
    const ComplexPair& b = system.right[static_cast<std::size_t>(i)];
    right.row(2 * i) << b.p.real(), b.p.imag();
    right.row(2 * i + 1) << b.q.real(), b.q.imag();
  }
  return solve_seconds<double, 2>(2 * system.matrix.size(), lower, right);
}

// The relaxation of one component below those of the others.
void add_problem(const MixedIntegerProblem& problem, Triplets<double>& lower, std::vector<double>& right) {
  const int first = static_cast<int>(right.size()), integers = first + 2 * problem.reals.size();
  for_each_block(problem.reals, [&](int i, int j, const Block& b) {
    add_block<double>(lower, first / 2 + i, first / 2 + j, {b.a, b.b, b.c, b.d});
  });
  for (const RealPair& b : problem.real_b) right.insert(right.end(), {b.p, b.q});
  for (std::size_t k = 0; k < problem.coupling.size(); ++k)
    for (const SparseTerm& term : problem.coupling[k])
      lower.emplace_back(integers + static_cast<int>(k), first + term.index, term.value);
  for (const auto& e : problem.integral) lower.emplace_back(integers + e.row, integers + e.column, e.value);
  right.insert(right.end(), problem.integral_b.begin(), problem.integral_b.end());
  // Pairs start at even places.
  if (right.size() % 2 != 0) {
    lower.emplace_back(static_cast<int>(right.size()), static_cast<int>(right.size()), 1.0);
    right.push_back(0);
  }
}

double map_seconds(const Stages& stages) {
  Triplets<double> lower;
  std::vector<double> right;
  for_each_map_problem(stages, [&](const MixedIntegerProblem& problem) { add_problem(problem, lower, right); });
  const int size = static_cast<int>(right.size());
  return solve_seconds<double, 1>(size, lower, Eigen::Map<const Eigen::VectorXd>(right.data(), size));
}

void run(const char* const* arguments) {
  std::ifstream file(arguments[0], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  Options options;
  if (std::string(arguments[1]) != "auto") options.threshold = std::atof(arguments[1]);
  options.reach = std::atof(arguments[2]);
  options.spacing = std::atof(arguments[3]);
  const Stages stages = run_stages(decode_image(bytes, arguments[0]), options, {});
  const FieldSystem field = assemble_field(stages.mesh, vertex_space(stages.mesh), grid_ink(stages));
  std::cout << nlohmann::json{{"field", complex_field_seconds(field)},
                              {"field_real", real_field_seconds(field)},
                              {"map", map_seconds(stages)},
                              {"vertices", stages.mesh.vertex_count()},
                              {"pixels", stages.ink.mask.data.size()}}
            << '\n';
}

}  // namespace
}  // namespace inkgrid

int main(int count, char** arguments) {
  if (count != 5) {
    std::cerr << "usage: yardstick DRAWING THRESHOLD|auto REACH SPACING\n";
    return 1;
  }
  try {
    inkgrid::run(arguments + 1);
  } catch (const std::exception& error) {
    std::cerr << "yardstick: " << error.what() << '\n';
    return 2;
  }
}
