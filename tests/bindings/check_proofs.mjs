// Prints what the checker of the browser says of each file named on standard input, a line of JSON each.
import { readFileSync } from "node:fs";

const { checkProof } = await import(process.argv[2]);
for (const path of readFileSync(0, "utf8").split("\n").filter((line) => line))
  console.log(JSON.stringify(await checkProof(readFileSync(path))));
