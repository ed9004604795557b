#ifndef impoint_terms_ghost_penalty_h
#define impoint_terms_ghost_penalty_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>
#include <impoint/terms/term.h>

#include <vector>

namespace Impoint
{
  /**
   * Holds the functions of cells that are filled in part only, by those of
   * their neighbours: a function that sees but a sliver of material has next to
   * no stiffness and mass of its own, and conditions or loads on the sliver
   * move it anywhere.
   *
   * The energy of a face is factor E / (2 h^2) int |u_1 - u_2|^2 over both its
   * cells, u_1 and u_2 being the polynomials of the one and the other cell,
   * continued (J. Preuss, Higher order unfitted isoparametric space-time FEM on
   * moving domains, 2018; in the limit that of jumps h^(2k-1) [d^k u/dn^k]^2 of
   * all normal derivatives, without the need to know them). A polynomial of the
   * basis' degree leaves no force: rigid motions, and all that the basis
   * reproduces, so the order of its error stays.
   *
   * It acts on the displacements since the grid was reset, which the grid
   * knows; so its forces do not pile up where it is reset every step. In
   * dynamics with consistent mass the same with rho in the place of E / h^2
   * acts on accelerations.
   *
   * Active cells without material, which only a boundary makes active (L
   * section 3.6), continue their neighbours' functions in this way whatever the
   * factor: what the boundary holds there is the material as it would go on,
   * and a boundary longer than the body asks nothing of a body that deforms
   * evenly. Forces and moments are in balance, also about the places that nodes
   * have moved to.
   */
  template <int dim>
  class GhostPenalty
  {
  public:
    GhostPenalty(const ActiveNodes<dim>    &active,
                 const MaterialPoints<dim> &points);

    /** @p value: of Young's modulus; 0, as at the start: holds nothing but
     * cells without material. */
    void set_factor(const double value)
    {
      factor = value;
    }

    /** Appends the faces to act on. Collective. */
    void find_links(Links &links);

    /** After find_links(). @p reached: cells without material where a boundary
     * has material to act on, increasing. Collective. */
    void set_reached(const std::vector<unsigned int> &reached);

    /** After the nodes of the links were numbered. */
    void new_active_set();

    unsigned int n_links() const
    {
      return faces.size();
    }

    /** Group of nodes of its link @p l. */
    unsigned int group(const unsigned int l) const
    {
      return active.link(first_link + l);
    }

    /** Whether active cell @p k continues some material. */
    bool holds(const unsigned int k) const
    {
      return contents[active.cell(k)].young > 0;
    }

    /** Whether link @p l holds a cell without material. */
    bool at_empty(const unsigned int l) const
    {
      return faces[l].at_empty;
    }

    void add(const unsigned int l, CellSystem &system) const;

    /** Mass times @p accelerations of the nodes, and alpha times it. */
    void add_mass(const unsigned int l,
                  const double      *accelerations,
                  const double       alpha,
                  CellSystem        &system) const;

    /** Calls function(entries, nodes, density) for each link that has a mass:
     * density entries[a n + b] between its nodes a and b, for all components.
     */
    template <typename Function>
    void for_masses(const Function &function) const
    {
      for (unsigned int l = 0; l < faces.size(); ++l)
        if (faces[l].density > 0)
          function(faces[l].matrix.data(),
                   active.nodes(group(l)),
                   faces[l].density);
    }

  private:
    /** What an active cell holds. */
    struct Content
    {
      double filled  = 0; // part of its volume, now
      double young   = 0; // [Pa], without material that of what it continues
      double density = 0; // [kg/m3], 0 without material
      bool   reached = false;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &filled &young &density &reached;
      }
    };

    struct Face
    {
      unsigned int first, second; // cells
      bool         at_empty;      // one is without material
      double       stiffness;     // factor E / h^2
      double       part = 1;      // of it that acts now
      double       density;       // factor rho

      std::vector<double> matrix; // n x n, the same for all components
    };

    Content content(const unsigned int k) const;
    bool    contents_stay();
    void    find_contents();
    void    set_content(const unsigned int c, const Content &value);
    void    share_contents();
    void    continue_material();
    template <typename Function>
    void for_neighbors(const unsigned int c, const Function &function) const;
    bool is_link(const unsigned int c, const unsigned int n) const;
    Face make_face(const unsigned int c,
                   const unsigned int f,
                   const unsigned int n) const;
    void find_faces();
    void integrate(const unsigned int l);

    const ActiveNodes<dim>    &active;
    const MaterialPoints<dim> &points;
    double                     factor = 0;
    std::vector<Face>          faces;
    std::vector<Content>       contents;   // of the grid's cells
    std::vector<unsigned int>  known;      // cells whose content is set
    std::vector<unsigned int>  last_cells; // active; their number with material
    unsigned int               first_link = 0; // among all links
  };
} // namespace Impoint

#endif
