// A button at each block of code copies its text, for a session of Python without prompts and answers.
function plain(text) {
  const typed = text.split("\n").filter((line) => /^(>>>|\.\.\.)( |$)/.test(line));
  return typed.length ? typed.map((line) => line.slice(4)).join("\n") + "\n" : text;
}

document.addEventListener("DOMContentLoaded", () => {
  if (!navigator.clipboard) return; // a page that was opened without https
  for (const block of document.querySelectorAll("div.highlight")) {
    const button = document.createElement("button");
    button.className = "copy";
    button.type = "button";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      await navigator.clipboard.writeText(plain(block.querySelector("pre").textContent));
      button.textContent = "Copied";
      setTimeout(() => (button.textContent = "Copy"), 1500);
    });
    block.appendChild(button);
  }
});
