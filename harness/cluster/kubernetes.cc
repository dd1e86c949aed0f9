#include "harness/cluster/kubernetes.h"

#include <nlohmann/json.hpp>

#include "harness/io/hash.h"
#include "harness/io/shell_word.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

constexpr const char* kScratch = "/scratch";

/// JSON is YAML: a quoted word that no reader takes for something else.
std::string Word(const std::string& text) {
  std::string dumped = Dump(text);
  while (!dumped.empty() && dumped.back() == '\n') dumped.pop_back();
  return dumped;
}

std::string Words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "[" : ", ") + Word(word);
  return text + "]";
}

std::string Container(const std::string& name, const std::vector<std::string>& arguments,
                      const KubernetesOptions& options) {
  std::string text = "      containers:\n";
  text += fmt::format("        - name: {}\n", name);
  text += fmt::format("          image: {}\n", Word(options.image));
  text += "          command: [\"aisle\"]\n";
  text += fmt::format("          args: {}\n", Words(arguments));
  text += fmt::format("          workingDir: {}\n", Word(options.working_folder.string()));
  text += fmt::format("          env:\n            - name: TMPDIR\n              value: {}\n",
                      kScratch);
  text += "          resources:\n            requests:\n";
  text += fmt::format("              cpu: \"{}\"\n", options.cpus);
  text += fmt::format("              memory: \"{:.0f}Mi\"\n", options.memory_mib);
  text += "          volumeMounts:\n            - name: report\n";
  text += fmt::format("              mountPath: {}\n", Word(options.out.string()));
  text += "            - name: scratch\n";
  text += fmt::format("              mountPath: {}\n", kScratch);
  text += "      volumes:\n        - name: report\n          persistentVolumeClaim:\n";
  text += fmt::format("            claimName: {}\n", Word(options.claim));
  return text + "        - name: scratch\n          emptyDir: {}\n";
}

std::string Head(const std::string& name) {
  return fmt::format(
      "apiVersion: batch/v1\nkind: Job\nmetadata:\n  name: {}\n  labels:\n    app: aisle\nspec:\n",
      Word(name));
}

}  // namespace

std::string KubernetesName(const std::string& suite, const std::filesystem::path& out) {
  constexpr std::size_t kLongest = 52;
  const std::string ending = fmt::format("-{:08x}", Hash(out.string()) & 0xffffffff);
  std::string made = "aisle-";
  for (const char c : suite) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    const bool upper = c >= 'A' && c <= 'Z';
    if (plain || upper) {
      made += upper ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (made.back() != '-') {
      made += '-';
    }
  }
  made.resize(std::min(made.size(), kLongest - ending.size()));
  while (made.back() == '-') made.pop_back();
  return made + ending;
}

std::string KubernetesRecipe(const KubernetesOptions& options, const std::filesystem::path& file) {
  const std::string name = KubernetesName(options.name, options.out);
  std::string text = fmt::format(
      "kubectl delete job {0} {0}-merge --ignore-not-found --cascade=foreground\n", name);
  text += fmt::format("kubectl apply -f {}\n", ShellWord(file.string()));
  // `wait` knows one condition: it asks for the other one now and then.
  text +=
      fmt::format("until kubectl wait --for=condition=complete --timeout=5m job/{0} ||\n", name);
  text += fmt::format("  kubectl wait --for=condition=failed --timeout=1s job/{0}; ", name);
  text += "do sleep 5; done\n";
  return text +
         fmt::format("kubectl patch job {}-merge -p '{{\"spec\":{{\"suspend\":false}}}}'\n", name);
}

std::string KubernetesJobs(const KubernetesOptions& options) {
  const std::string name = KubernetesName(options.name, options.out), out = options.out.string();
  const std::size_t at_once =
      options.at_most > 0 ? std::min(static_cast<std::size_t>(options.at_most), options.tasks)
                          : options.tasks;
  std::string text = Head(name);
  text += fmt::format("  completionMode: Indexed\n  completions: {}\n  parallelism: {}\n",
                      options.tasks, at_once);
  // It counts for the whole Job: one evicted pod a task must not end the night.
  text += fmt::format("  backoffLimit: {}\n", options.tasks + 6);
  text += "  template:\n    spec:\n      restartPolicy: Never\n";
  text += Container("task", {"run-task", out}, options);
  text += "---\n" + Head(name + "-merge");
  text += "  suspend: true\n  backoffLimit: 0\n";
  text += "  template:\n    spec:\n      restartPolicy: Never\n";
  return text + Container("merge", {"merge", out}, options);
}

}  // namespace aisle
