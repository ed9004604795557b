#include <impoint/base/parameter_file.h>
#include <impoint/materials/models.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

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



      void check_unused(const ParameterFile &file,
                        const std::string   &section,
                        const Model         &model)
      {
        for (const ModelEntry &entry : model_entries())
          if (file.is_set(section + "/" + entry.name) &&
              std::count(model.entries.begin(),
                         model.entries.end(),
                         entry.name) == 0)
            throw file.error(section + "/" + entry.name,
                             "'" + entry.name +
                               "' means nothing to the model '" + model.name +
                               "'",
                             "Take the entry away, or set Model = " +
                               Words::join(entry.models(), ", ") + ".");
      }
    } // namespace



    void declare_parameters(ParameterFile &file, const std::string &section)
    {
      const std::vector<std::string> path = Words::split(section, '/');
      ParameterHandler              &prm  = file.handler();
      for (const std::string &name : path)
        prm.enter_subsection(name);

      std::vector<std::string> names, helps;
      for (const Model &row : models())
        {
          names.push_back(row.name);
          helps.push_back("'" + row.name + "': " + row.help);
        }
      prm.declare_entry(
        "Model",
        names.front(),
        Patterns::Selection(Words::join(names, "|")),
        "The law of stress; in 2D: plane strain. All but 'linear elastic' hold "
        "for finite strains. " +
          Words::join(helps, "; ") + ".");
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
      for (const ModelEntry &entry : model_entries())
        prm.declare_entry(entry.name,
                          entry.default_value,
                          *entry.pattern,
                          Words::join(entry.models(), ", ") + ": " +
                            entry.help);

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
      const Model &chosen = model(file.value(section + "/Model"));
      check_unused(file, section, chosen);
      return std::get<dim - 2>(chosen.make)(moduli, file, section);
    }
  } // namespace Materials
} // namespace Impoint

template std::unique_ptr<Impoint::Materials::Material<2>>
Impoint::Materials::create_material<2>(const ParameterFile &,
                                       const std::string &);
template std::unique_ptr<Impoint::Materials::Material<3>>
Impoint::Materials::create_material<3>(const ParameterFile &,
                                       const std::string &);
