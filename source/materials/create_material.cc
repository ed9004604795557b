#include <impoint/base/parameter_file.h>
#include <impoint/materials/drucker_prager.h>
#include <impoint/materials/elastoplastic.h>
#include <impoint/materials/hencky.h>
#include <impoint/materials/linear_elastic.h>
#include <impoint/materials/mohr_coulomb.h>
#include <impoint/materials/neo_hookean.h>
#include <impoint/materials/st_venant_kirchhoff.h>
#include <impoint/materials/von_mises.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>

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



      double number(const ParameterFile &file, const std::string &path)
      {
        return Utilities::string_to_double(file.value(path));
      }



      /** Entries of plastic models, and the models that use them. */
      const std::map<std::string, std::vector<std::string>> plastic_entries = {
        {"Cohesion", {"Mohr-Coulomb", "Drucker-Prager"}},
        {"Friction angle", {"Mohr-Coulomb", "Drucker-Prager"}},
        {"Dilation angle", {"Mohr-Coulomb", "Drucker-Prager"}},
        {"Close gaps", {"Mohr-Coulomb", "Drucker-Prager"}},
        {"Yield stress", {"von Mises"}},
        {"Softening residual", {"Mohr-Coulomb", "Drucker-Prager", "von Mises"}},
        {"Softening strain", {"Mohr-Coulomb", "Drucker-Prager", "von Mises"}}};



      void check_unused(const ParameterFile &file,
                        const std::string   &section,
                        const std::string   &model)
      {
        for (const auto &[entry, models] : plastic_entries)
          if (file.is_set(section + "/" + entry) &&
              std::find(models.begin(), models.end(), model) == models.end())
            throw file.error(section + "/" + entry,
                             "'" + entry + "' means nothing to the model '" +
                               model + "'",
                             "Take the entry away, or set Model = " +
                               Words::join(models, ", ") + ".");
      }



      void check_angles(const ParameterFile &file, const std::string &section)
      {
        const std::string dilation = section + "/Dilation angle";
        if (number(file, dilation) > number(file, section + "/Friction angle"))
          throw file.error(dilation,
                           "the dilation angle is " + file.value(dilation) +
                             ", above the friction angle: flow would create "
                             "energy",
                           "Set it from 0 to 'Friction angle'.");
        if (number(file, section + "/Friction angle") == 0 &&
            number(file, section + "/Cohesion") == 0)
          throw file.error(section + "/Friction angle",
                           "the material has neither friction nor cohesion",
                           "Set 'Friction angle' [degrees] or 'Cohesion' [Pa] "
                           "above 0.");
      }



      Softening softening(const ParameterFile &file, const std::string &section)
      {
        Softening result;
        result.residual = number(file, section + "/Softening residual");
        result.strain   = number(file, section + "/Softening strain");
        if (result.residual < 1 && !(result.strain > 0))
          throw file.error(section + "/Softening strain",
                           "strength falls without a strain to fall over",
                           "Set the plastic strain, e.g. 0.1, or 'Softening "
                           "residual = 1'.");
        if (result.residual == 1 && file.is_set(section + "/Softening strain"))
          throw file.error(section + "/Softening strain",
                           "'Softening strain' is set, but nothing softens",
                           "Set 'Softening residual' below 1, or take the "
                           "entry away.");
        return result;
      }



      std::unique_ptr<const YieldSurface>
      create_surface(const ParameterFile &file,
                     const std::string   &section,
                     const std::string   &model)
      {
        if (model == "von Mises")
          {
            const std::string path = section + "/Yield stress";
            if (!(number(file, path) > 0))
              throw file.error(path,
                               "the yield stress is " + file.value(path),
                               "Set it in Pa, above 0.");
            return std::make_unique<VonMises>(number(file, path));
          }
        check_angles(file, section);
        const double cohesion = number(file, section + "/Cohesion");
        const double friction = number(file, section + "/Friction angle");
        const double dilation = number(file, section + "/Dilation angle");
        if (model == "Mohr-Coulomb")
          return std::make_unique<MohrCoulomb>(cohesion, friction, dilation);
        Assert(model == "Drucker-Prager", ExcNotImplemented());
        return std::make_unique<DruckerPrager>(cohesion, friction, dilation);
      }



      void declare_plastic_entries(ParameterHandler &prm)
      {
        prm.declare_entry("Cohesion",
                          "0",
                          Patterns::Double(0),
                          "Mohr-Coulomb, Drucker-Prager: c [Pa]; may be 0.");
        prm.declare_entry("Friction angle",
                          "0",
                          Patterns::Double(0, 89),
                          "Mohr-Coulomb, Drucker-Prager: phi [degrees].");
        prm.declare_entry("Dilation angle",
                          "0",
                          Patterns::Double(0, 89),
                          "Mohr-Coulomb, Drucker-Prager: psi [degrees], from 0 "
                          "(flow keeps the volume) to the friction angle "
                          "(associated flow).");
        prm.declare_entry("Yield stress",
                          "0",
                          Patterns::Double(0),
                          "Von Mises: in uniaxial stress [Pa].");
        prm.declare_entry(
          "Softening residual",
          "1",
          Patterns::Double(0, 1),
          "Plastic models: part r of cohesion or yield stress that is left "
          "after large plastic strains kappa; on the way it is r + (1 - r) "
          "exp(-kappa / softening strain), with kappa at the step's start.");
        prm.declare_entry("Softening strain",
                          "0",
                          Patterns::Double(0),
                          "Plastic models: equivalent plastic strain in which "
                          "strength decays [-].");
        prm.declare_entry(
          "Close gaps",
          "true",
          Patterns::Bool(),
          "Mohr-Coulomb, Drucker-Prager: what was torn open bears no pressure "
          "before it is closed again. 'false', as in the papers: it does at "
          "once, and the volume of what flows grows with time.");
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
          "linear elastic|St. Venant-Kirchhoff|neo-Hookean|Hencky|"
          "Mohr-Coulomb|Drucker-Prager|von Mises"),
        "The law of stress. 'linear elastic': small strains, stress summed up "
        "over the steps; one iteration a step. The others hold for finite "
        "strains: 'St. Venant-Kirchhoff': linear in Green's strain, moderate "
        "strains only; 'neo-Hookean': mu (b - 1) + lambda ln J 1; 'Hencky': "
        "linear in the logarithmic strain; 'Mohr-Coulomb', 'Drucker-Prager', "
        "'von Mises': Hencky's law and plastic flow (perfectly plastic or "
        "softening). In 2D: plane strain.");
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
      declare_plastic_entries(prm);

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
      check_unused(file, section, model);

      if (model == "linear elastic")
        return std::make_unique<LinearElastic<dim>>(moduli);
      if (model == "St. Venant-Kirchhoff")
        return std::make_unique<StVenantKirchhoff<dim>>(moduli);
      if (model == "neo-Hookean")
        return std::make_unique<NeoHookean<dim>>(moduli);
      if (model == "Hencky")
        return std::make_unique<Hencky<dim>>(moduli);
      return std::make_unique<Elastoplastic<dim>>(
        moduli,
        create_surface(file, section, model),
        softening(file, section),
        file.value(section + "/Close gaps") == "true");
    }
  } // namespace Materials
} // namespace Impoint

template std::unique_ptr<Impoint::Materials::Material<2>>
Impoint::Materials::create_material<2>(const ParameterFile &,
                                       const std::string &);
template std::unique_ptr<Impoint::Materials::Material<3>>
Impoint::Materials::create_material<3>(const ParameterFile &,
                                       const std::string &);
