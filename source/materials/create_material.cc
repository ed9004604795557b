#include <impoint/base/parameter_file.h>
#include <impoint/materials/hencky.h>
#include <impoint/materials/linear_elastic.h>
#include <impoint/materials/neo_hookean.h>
#include <impoint/materials/st_venant_kirchhoff.h>

#include <deal.II/base/utilities.h>

namespace Impoint
{
  namespace Materials
  {
    namespace
    {
      double positive_young(const ParameterFile &file, const std::string &path)
      {
        const std::string advice =
          "Set it to the stiffness of the material in Pa, a number above 0.";
        if (!file.is_set(path))
          throw file.error(path, "Young's modulus has no default", advice);

        const double young = Utilities::string_to_double(file.value(path));
        if (!(young > 0))
          throw file.error(path,
                           "Young's modulus is " + file.value(path),
                           advice);
        return young;
      }



      double stable_poisson(const ParameterFile &file, const std::string &path)
      {
        const double poisson = Utilities::string_to_double(file.value(path));
        if (!(poisson > -1 && poisson < 0.5))
          throw file.error(
            path,
            "Poisson's ratio is " + file.value(path) +
              ": there the shear modulus E / (2 (1 + nu)) or the "
              "bulk modulus E / (3 (1 - 2 nu)) isn't finite and "
              "positive",
            "Choose -1 < nu < 0.5; for nearly incompressible "
            "material for instance 0.49.");
        return poisson;
      }
    } // namespace



    void declare_parameters(ParameterFile &file, const std::string &section)
    {
      const std::vector<std::string> path = Words::split(section, '/');
      ParameterHandler              &prm  = file.handler();
      for (const std::string &name : path)
        prm.enter_subsection(name);

      prm.declare_entry(
        "Model",
        "linear elastic",
        Patterns::Selection(
          "linear elastic|St. Venant-Kirchhoff|neo-Hookean|Hencky"),
        "The law of stress. 'linear elastic': small strains, stress summed up "
        "over the steps; one iteration a step. The others hold for finite "
        "strains: 'St. Venant-Kirchhoff': linear in Green's strain, moderate "
        "strains only; 'neo-Hookean': mu (b - 1) + lambda ln J 1; 'Hencky': "
        "linear in the logarithmic strain. In 2D: plane strain.");
      prm.declare_entry(
        "Young's modulus",
        "0",
        Patterns::Double(),
        "Stiffness E > 0 in uniaxial stress [Pa]; must be set.");
      prm.declare_entry("Poisson's ratio",
                        "0.3",
                        Patterns::Double(),
                        "Lateral contraction nu in uniaxial stress [-], "
                        "-1 < nu < 0.5.");

      for (unsigned int i = 0; i < path.size(); ++i)
        prm.leave_subsection();
    }



    template <int dim>
    std::unique_ptr<Material<dim>> create_material(const ParameterFile &file,
                                                   const std::string   &section)
    {
      const ElasticModuli moduli(
        positive_young(file, section + "/Young's modulus"),
        stable_poisson(file, section + "/Poisson's ratio"));
      const std::string model = file.value(section + "/Model");

      if (model == "linear elastic")
        return std::make_unique<LinearElastic<dim>>(moduli);
      if (model == "St. Venant-Kirchhoff")
        return std::make_unique<StVenantKirchhoff<dim>>(moduli);
      if (model == "neo-Hookean")
        return std::make_unique<NeoHookean<dim>>(moduli);
      if (model == "Hencky")
        return std::make_unique<Hencky<dim>>(moduli);

      Assert(false, ExcMessage("'" + model + "' is declared but not created."));
      return nullptr;
    }
  } // namespace Materials
} // namespace Impoint

template std::unique_ptr<Impoint::Materials::Material<2>>
Impoint::Materials::create_material<2>(const ParameterFile &,
                                       const std::string &);
template std::unique_ptr<Impoint::Materials::Material<3>>
Impoint::Materials::create_material<3>(const ParameterFile &,
                                       const std::string &);
