// Reads YAML on stdin and holds each document, a batch/v1 Job, against the schema that Kubernetes
// publishes (as kubernetes-models has it). Prints the documents as one JSON array; a fault ends it
// with exit code 1 and a message.
import { readFileSync } from "node:fs";
import { Job } from "kubernetes-models/batch/v1";
import { parseAllDocuments } from "yaml";

const jobs = parseAllDocuments(readFileSync(0, "utf8"), { strict: true }).map((document) => {
  if (document.errors.length > 0) throw document.errors[0];
  const job = document.toJS();
  if (job.apiVersion !== "batch/v1" || job.kind !== "Job") throw new Error("is no batch/v1 Job");
  new Job(job).validate();
  return job;
});
console.log(JSON.stringify(jobs));
