// Makes modules of the page's scripts, whose own addresses no page from a disk may ask for: each imports those before it by name.
(async () => {
  const addresses = new Map();
  let last;
  for (const script of document.querySelectorAll("script.module")) {
    const text = script.textContent.replace(
      /\b((?:from|import)\s*)(["'])([^"'\n]+)\2/g,
      (whole, word, quote, name) => (addresses.has(name) ? `${word}${quote}${addresses.get(name)}${quote}` : whole),
    );
    last = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    addresses.set(script.dataset.name, last);
  }
  await import(last);
})().catch((error) => {
  const words = document.getElementById("trouble");
  words.textContent = `The particles cannot be shown (${error.message}). A current browser with WebGL 2 shows them.`;
  words.hidden = false;
  document.documentElement.dataset.trouble = error.message;
});
