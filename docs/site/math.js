// MathJax 2 of Debian, for what pymdownx.arithmatex marks.
window.MathJax = {
  jax: ["input/TeX", "output/CommonHTML"],
  extensions: ["tex2jax.js"],
  TeX: { extensions: ["AMSmath.js", "AMSsymbols.js", "noErrors.js", "noUndefined.js"] },
  tex2jax: {
    inlineMath: [["\\(", "\\)"]],
    displayMath: [["\\[", "\\]"]],
    ignoreClass: ".*",
    processClass: "arithmatex",
  },
  CommonHTML: { linebreaks: { automatic: true } },
  showMathMenu: false,
  messageStyle: "none",
};
