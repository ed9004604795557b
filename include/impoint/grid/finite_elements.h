#ifndef impoint_grid_finite_elements_h
#define impoint_grid_finite_elements_h

#include <impoint/grid/cell_functions.h>

#include <memory>

namespace Impoint
{
  /**
   * Lagrange elements of degree 1 or 2: FE_Q on quadrilaterals and hexahedra,
   * FE_SimplexP on triangles and tetrahedra. Hanging nodes never appear: their
   * values are written in terms of the nodes they depend on, which only
   * lengthens the list of a cell next to them.
   */
  template <int dim>
  class FiniteElements : public CellFunctions<dim>
  {
  public:
    FiniteElements(const BackgroundGrid<dim> &grid, const unsigned int degree);
    ~FiniteElements() override;

    void evaluate(const unsigned int c,
                  const Point<dim>  &xi,
                  double            *support) const override;

    void evaluate_all(const unsigned int                 c,
                      const ArrayView<const Point<dim>> &xi,
                      double *supports) const override;

    std::vector<unsigned int>
    nodes_on_face(const unsigned int c, const unsigned int f) const override;

    bool can_hold_face(const unsigned int, const unsigned int) const override
    {
      return true;
    }

  private:
    struct Elements; // DoFHandler and what goes with it

    static constexpr unsigned int most_functions = dim == 2 ? 9 : 27;

    void number_nodes();
    void list_cell_nodes();
    void describe_functions();
    void list_hanging_cell(const std::vector<types::global_dof_index> &indices);
    void place_on_lattice();

    void reference_functions(const Point<dim> &xi,
                             double           *values,
                             double           *gradients) const;
    void quadratic_tensor_functions(const Point<dim> &xi,
                                    double           *values,
                                    double           *gradients) const;
    void quadratic_simplex_functions(const Point<dim> &xi,
                                     double           *values,
                                     double           *gradients) const;
    void evaluate_by_fe_values(const unsigned int c,
                               const Point<dim>  &xi,
                               double            *values,
                               double            *gradients) const;

    const unsigned int        degree;
    unsigned int              n_functions = 0; // of a cell without hanging ones
    std::unique_ptr<Elements> elements;

    // Quadratic functions. On a hypercube: which of the functions of (0, 1/2,
    // 1) they are in each direction. On a simplex: between which vertices they
    // are 1, twice the same for a vertex.
    std::vector<std::array<unsigned char, dim>> factors;
    std::vector<std::array<unsigned char, 2>>   ends;

    // Cells with hanging nodes: position in hanging, or nowhere. Row-major
    // functions x nodes: the weight of each node in each function.
    std::vector<unsigned int>        hanging_index;
    std::vector<std::vector<double>> hanging;
  };
} // namespace Impoint

#endif
