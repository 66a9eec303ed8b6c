// Parses Julia files with tree-sitter and fails on any error node.
// usage: node julia_parse.js FOLDER_OF_NODE_MODULES FILE...   (web-tree-sitter, tree-sitter-julia with its .wasm)
const path = require("path");
const fs = require("fs");
const [modules, ...files] = process.argv.slice(2);
const wts = require(path.join(modules, "web-tree-sitter"));
const Parser = wts.Parser || wts;

function errors(node, found) {
  if (node.isError || node.isMissing) found.push(`line ${node.startPosition.row + 1}: ${node.isMissing ? "missing " + node.type : "cannot parse"}`);
  else if (node.hasError) node.children.forEach((c) => errors(c, found));
  return found;
}

(async () => {
  await Parser.init();
  const load = (wts.Language || Parser.Language).load;
  const parser = new Parser();
  parser.setLanguage(await load(path.join(modules, "tree-sitter-julia", "tree-sitter-julia.wasm")));
  let bad = 0;
  const check = (name, text) => errors(parser.parse(text).rootNode, []).map((e) => `${name}: ${e}`);
  if (!check("control", "function f(\n x = 3 end end").length) { console.log("the parser finds no error in broken text"); bad = 1; }
  for (const file of files) {
    const found = check(file, fs.readFileSync(file, "utf8"));
    found.forEach((e) => console.log(e));
    bad += found.length;
  }
  console.log(bad ? `${bad} errors` : `${files.length} files parse`);
  process.exit(bad ? 1 : 0);
})();
