#include <impoint/base/exceptions.h>
#include <impoint/solver/lu_solver.h>

#include <deal.II/base/exceptions.h>

#include <umfpack.h>

#include <string>

namespace Impoint
{
  using namespace dealii;

  /** UMFPACK's objects and the scalar matrix by rows, which to UMFPACK are the
   * columns of the transpose. */
  template <int dim>
  struct LuSolver<dim>::Implementation
  {
    Implementation();
    ~Implementation();
    void clear_numeric();
    void clear();
    void check_status(const int status, const char *activity) const;

    double control[UMFPACK_CONTROL];
    void  *symbolic = nullptr, *numeric = nullptr;

    std::vector<int>    row_start, column_index;
    std::vector<double> values;

    // of a solve
    std::vector<int>    integer_work;
    std::vector<double> work;
  };

  template <int dim>
  LuSolver<dim>::Implementation::Implementation()
  {
    umfpack_di_defaults(control);
    // pivots on the diagonal where they are large enough: it is far from zero
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control[UMFPACK_IRSTEP]   = 0;
  }

  template <int dim>
  LuSolver<dim>::Implementation::~Implementation()
  {
    clear();
  }

  template <int dim>
  void LuSolver<dim>::Implementation::clear_numeric()
  {
    if (numeric != nullptr)
      umfpack_di_free_numeric(&numeric);
  }

  template <int dim>
  void LuSolver<dim>::Implementation::clear()
  {
    clear_numeric();
    if (symbolic != nullptr)
      umfpack_di_free_symbolic(&symbolic);
  }

  template <int dim>
  void LuSolver<dim>::Implementation::check_status(const int   status,
                                                   const char *activity) const
  {
    if (status == UMFPACK_ERROR_out_of_memory)
      throw RunFailed(
        std::string("The direct solver cannot ") + activity + " a matrix of " +
        std::to_string(row_start.size() - 1) +
        " unknowns: the factor is too large for the memory or for 32-bit "
        "indices. Choose a coarser grid.");
    AssertThrow(status >= 0,
                ExcMessage(std::string("UMFPACK failed to ") + activity +
                           " the matrix, status " + std::to_string(status)));
  }

  template <int dim>
  LuSolver<dim>::LuSolver()
    : implementation(std::make_unique<Implementation>())
  {}

  template <int dim>
  LuSolver<dim>::~LuSolver() = default;

  template <int dim>
  void LuSolver<dim>::new_pattern(const BlockPattern &pattern)
  {
    Implementation &data = *implementation;
    data.clear();
    data.row_start.assign(1, 0);
    data.column_index.clear();
    for (unsigned int node = 0; node < pattern.n_rows(); ++node)
      for (int row = 0; row < dim; ++row)
        {
          for (std::size_t k = pattern.row_start[node];
               k < pattern.row_start[node + 1];
               ++k)
            for (int column = 0; column < dim; ++column)
              data.column_index.push_back(pattern.columns[k] * dim + column);
          data.row_start.push_back(data.column_index.size());
        }
    data.values.resize(data.column_index.size());

    const int n = data.row_start.size() - 1;
    data.check_status(umfpack_di_symbolic(n,
                                          n,
                                          data.row_start.data(),
                                          data.column_index.data(),
                                          nullptr,
                                          &data.symbolic,
                                          data.control,
                                          nullptr),
                      "analyse");
    data.integer_work.resize(n);
    data.work.resize(5 * n);
  }

  template <int dim>
  bool LuSolver<dim>::factorize(const BlockMatrix<dim> &matrix)
  {
    Implementation &data  = *implementation;
    double         *entry = data.values.data();
    for (unsigned int node = 0; node < matrix.pattern->n_rows(); ++node)
      for (int row = 0; row < dim; ++row)
        for (std::size_t k = matrix.pattern->row_start[node];
             k < matrix.pattern->row_start[node + 1];
             ++k)
          for (int column = 0; column < dim; ++column)
            *entry++ = matrix.values[(k * dim + row) * dim + column];

    data.clear_numeric();
    const int status = umfpack_di_numeric(data.row_start.data(),
                                          data.column_index.data(),
                                          data.values.data(),
                                          data.symbolic,
                                          &data.numeric,
                                          data.control,
                                          nullptr);
    data.check_status(status, "factorise");
    return status == UMFPACK_OK;
  }

  template <int dim>
  void LuSolver<dim>::vmult(const std::vector<double> &b,
                            std::vector<double>       &x) const
  {
    Implementation &data = *implementation;
    x.resize(b.size());
    data.check_status(umfpack_di_wsolve(UMFPACK_At,
                                        data.row_start.data(),
                                        data.column_index.data(),
                                        data.values.data(),
                                        x.data(),
                                        b.data(),
                                        data.numeric,
                                        data.control,
                                        nullptr,
                                        data.integer_work.data(),
                                        data.work.data()),
                      "solve with");
  }

  template class LuSolver<2>;
  template class LuSolver<3>;
} // namespace Impoint
